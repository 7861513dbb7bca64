// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <variant>

#include "detector/clog.h"
#include "detector/hit_row.h"
#include "detector/t3p.h"
#include "detector/t3pa.h"
#include "fuzz/targets.h"

namespace comptonaut {
namespace {

bool same(const StreamItem& a, const StreamItem& b) {
  return a.kind == b.kind && a.line == b.line && a.index == b.index && a.value == b.value && a.hit() == b.hit();
}

void check_item(const StreamItem& item) {
  if (item.kind != StreamItem::Kind::kHit) return;
  require_law(item.energy_keV >= 0.0F, "energies are not negative");
  require_law(item.energy_keV > 0.0F || item.tot > 0, "a hit has an energy or a ToT");
}

/// What a parser says does not depend on how its bytes are cut, and no row is lost without a word.
template <class Parser>
void check_parser(std::span<const char> bytes) {
  const unsigned choice = take_choice(bytes);
  std::vector<StreamItem> whole, cut;
  const auto add_to = [](std::vector<StreamItem>& all, std::span<const StreamItem> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  Parser at_once, in_parts;
  const std::vector<char> copy(bytes.begin(), bytes.end());
  add_to(whole, at_once.parse(copy));
  add_to(whole, at_once.end());
  in_pieces(bytes, choice, [&](const std::vector<char>& piece) { add_to(cut, in_parts.parse(piece)); });
  add_to(cut, in_parts.end());
  require_law(std::equal(whole.begin(), whole.end(), cut.begin(), cut.end(), same), "the same items however cut");
  require_law(at_once.rows() == in_parts.rows(), "the same rows however cut");
  require_law(at_once.faults().count == in_parts.faults().count, "the same faults however cut");
  require_law(at_once.faults().first_line == in_parts.faults().first_line, "at the same lines however cut");
  std::for_each(whole.begin(), whole.end(), check_item);
}

}  // namespace

void fuzz_t3pa(std::span<const char> bytes) { check_parser<T3paParser>(bytes); }
void fuzz_t3p(std::span<const char> bytes) { check_parser<T3pParser>(bytes); }
void fuzz_clog(std::span<const char> bytes) { check_parser<ClogParser>(bytes); }

}  // namespace comptonaut
