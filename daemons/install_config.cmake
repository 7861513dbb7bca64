# SPDX-License-Identifier: BSD-3-Clause
# Copies what is in ${config_folder} to /etc/comptonaut, but never over what somebody has changed there.
set(target_folder $ENV{DESTDIR}/etc/comptonaut)
file(GLOB_RECURSE files RELATIVE ${config_folder} ${config_folder}/*)
foreach(file IN LISTS files)
  if(EXISTS ${target_folder}/${file})
    message(STATUS "Kept: ${target_folder}/${file}")
  else()
    get_filename_component(folder ${target_folder}/${file} DIRECTORY)
    file(INSTALL ${config_folder}/${file} DESTINATION ${folder})
  endif()
endforeach()
