# SPDX-License-Identifier: BSD-3-Clause
# Copies what is in ${config_folder} to /etc/comptonaut, but never over what is there: somebody may have changed it.
file(GLOB_RECURSE files RELATIVE ${config_folder} ${config_folder}/*)
foreach(file IN LISTS files)
  if(EXISTS $ENV{DESTDIR}/etc/comptonaut/${file})
    message(STATUS "Kept: $ENV{DESTDIR}/etc/comptonaut/${file}")
  else()
    get_filename_component(folder /etc/comptonaut/${file} DIRECTORY)
    file(INSTALL ${config_folder}/${file} DESTINATION ${folder}) # DESTDIR goes before it
  endif()
endforeach()
