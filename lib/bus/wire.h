// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace comptonaut {

/// Whether `bytes` begin with a whole message of this fingerprint, with every count borne out by the bytes that follow
/// it. To be asked before a generated decode(), which resizes its vectors by any count that it reads.
///
/// `layout` has one item per member, in the order of the .lcm file:
///   1 int8_t    ? boolean    4 int32_t or float    8 int64_t or double    s string
///   n int32_t that counts elements    *X as many X as the last n said    {...} a struct    blanks are for the eye
[[nodiscard]] bool well_formed(std::span<const std::uint8_t> bytes, std::int64_t fingerprint, std::string_view layout);

/// The message that `bytes` begin with. nullopt unless well_formed. Trailing bytes are ignored.
template <class Message>
[[nodiscard]] std::optional<Message> unpack(std::span<const std::uint8_t> bytes, std::string_view layout) {
  if (bytes.size() > std::numeric_limits<int>::max() || !well_formed(bytes, Message::getHash(), layout)) return {};
  try {
    Message message;
    if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return {};
    return message;
  } catch (const std::exception&) {
    return {};
  }
}

template <class Message>
[[nodiscard]] std::vector<std::uint8_t> pack(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// Fills a vector of messages and its count field.
template <class Message, class Domain, class Convert>
void pack_all(const std::vector<Domain>& from, std::int32_t& count, std::vector<Message>& to, Convert convert) {
  count = static_cast<std::int32_t>(from.size());
  to.reserve(from.size());
  for (const Domain& value : from) to.push_back(convert(value));
}

/// Converts each; false at the first that is not valid.
template <class Message, class Domain, class Convert>
[[nodiscard]] bool unpack_all(const std::vector<Message>& from, std::vector<Domain>& to, Convert convert) {
  to.reserve(from.size());
  for (const Message& message : from) {
    std::optional<Domain> value = convert(message);
    if (!value) return false;
    to.push_back(std::move(*value));
  }
  return true;
}

template <class Scalar>
void pack_vector(const Eigen::Vector3d& from, Scalar (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<Scalar>(from[i]);
}

template <class Scalar>
[[nodiscard]] Eigen::Vector3d unpack_vector(const Scalar (&from)[3]) {
  return Eigen::Vector3d(from[0], from[1], from[2]);
}

/// On the wire a quaternion is w, x, y, z.
template <class Scalar>
void pack_quaternion(const Eigen::Quaterniond& from, Scalar (&to)[4]) {
  const double wxyz[4] = {from.w(), from.x(), from.y(), from.z()};
  for (int i = 0; i < 4; ++i) to[i] = static_cast<Scalar>(wxyz[i]);
}

template <class Scalar>
[[nodiscard]] Eigen::Quaterniond unpack_quaternion(const Scalar (&from)[4]) {
  return Eigen::Quaterniond(from[0], from[1], from[2], from[3]);
}

}  // namespace comptonaut
