// SPDX-License-Identifier: BSD-3-Clause
#include "world/octomap_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace comptonaut {
namespace {

constexpr int kDepth = 16;  // of the smallest voxels; a binary file's nodes hold their children, so end one level above
constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";

struct Header {
  std::string id;
  double resolution_m = 0.0;
  std::size_t data_at = 0;  ///< offset of the first node
};

// Lines "key value" up to the line "data"; "#" begins a comment.
Header read_header(const std::string& text) {
  Header header;
  std::istringstream lines(text);
  lines.imbue(std::locale::classic());
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string key;
    words >> key;
    if (key == "id") words >> header.id;
    if (key == "res") words >> header.resolution_m;
    if (key == "data" && !lines.eof()) {
      header.data_at = static_cast<std::size_t>(lines.tellg());
      return header;
    }
  }
  throw std::runtime_error("its header has no line 'data'");
}

/// Walks over the nodes of the data part, as a reader would, without building them.
class NodeWalk {
 public:
  NodeWalk(std::string_view data, bool binary) : data_(data), binary_(binary) {}

  void check() {
    if (data_.empty()) return;
    descend(0);
    if (at_ != data_.size()) {
      throw std::runtime_error(fmt::format("{} bytes are left over after its last node", data_.size() - at_));
    }
  }

 private:
  // In a binary file a node is two bits for each of eight children (11: an inner node); in the other one its log odds
  // as a float, and a byte that says which children it has.
  void descend(int depth) {
    if (depth > (binary_ ? kDepth - 1 : kDepth)) throw std::runtime_error("its nodes are nested deeper than 16 levels");
    int children = 0;
    if (binary_) {
      const unsigned bits = byte() | byte() << 8;
      for (int i = 0; i < 8; ++i) children += ((bits >> (2 * i)) & 3U) == 3U;
    } else {
      if (!std::isfinite(log_odds())) throw std::runtime_error("a node's occupancy is not a number");
      for (unsigned bits = byte(); bits != 0; bits >>= 1) children += bits & 1U;
    }
    for (int i = 0; i < children; ++i) descend(depth + 1);
  }

  unsigned byte() {
    if (at_ == data_.size()) throw std::runtime_error("it is cut short");
    return static_cast<unsigned char>(data_[at_++]);
  }

  float log_odds() {
    std::array<unsigned char, sizeof(float)> raw;
    for (auto& b : raw) b = static_cast<unsigned char>(byte());
    float value;
    std::memcpy(&value, raw.data(), sizeof(float));
    return value;
  }

  std::string_view data_;
  std::size_t at_ = 0;
  bool binary_;
};

std::unique_ptr<octomap::OcTree> parse(const std::string& bytes) {
  const bool binary = bytes.starts_with(kBinaryMagic);
  if (!binary && !bytes.starts_with(kFullMagic)) {
    throw std::runtime_error(fmt::format("it begins neither with '{}' (.bt) nor '{}' (.ot)", kBinaryMagic, kFullMagic));
  }
  const Header header = read_header(bytes);
  if (header.id != "OcTree") throw std::runtime_error(fmt::format("its id is '{}', must be OcTree", header.id));
  if (!(header.resolution_m >= 0.01 && header.resolution_m <= 10.0)) {
    throw std::runtime_error(fmt::format("its res is {} m, must be 0.01 to 10", header.resolution_m));
  }
  const std::string_view data = std::string_view(bytes).substr(header.data_at);
  NodeWalk(data, binary).check();

  auto tree = std::make_unique<octomap::OcTree>(header.resolution_m);
  std::istringstream nodes{std::string(data)};
  if (data.empty()) return tree;
  binary ? tree->readBinaryData(nodes) : tree->readData(nodes);
  tree->toMaxLikelihood();
  tree->prune();
  return tree;
}

}  // namespace

std::unique_ptr<octomap::OcTree> read_octomap(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw std::runtime_error(fmt::format("{}: cannot open the OctoMap file", file.string()));
  }
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  try {
    return parse(bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: not a usable OctoMap file: {}", file.string(), error.what()));
  }
}

}  // namespace comptonaut
