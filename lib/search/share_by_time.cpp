// SPDX-License-Identifier: BSD-3-Clause
#include "search/share_by_time.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "search/tour.h"

namespace comptonaut {
namespace {

using Order = std::vector<std::size_t>;
using Places = std::span<const Eigen::Vector3d>;

constexpr double kGain = 1e-3;  ///< of the longest flight: less is not worth a change
constexpr std::size_t kBothMax = 100;
constexpr std::size_t kTried = 8;  ///< of the changes that look best

class Sharing {
 public:
  Sharing(Places starts_W, Places points_W, const MotionLimits& limits)
      : starts_W_(starts_W),
        points_W_(points_W),
        limits_(limits),
        shares_(starts_W.size()),
        times_s_(starts_W.size()),
        ordered_(starts_W.size(), false) {}

  /// The better of two beginnings, improved; of many points only one, which takes less time.
  std::vector<Order> run() {
    begin_along_tour();
    improve();
    if (points_W_.size() > kBothMax) return shares_;
    const double along_tour_s = times_s_[longest()];
    const std::vector<Order> along_tour = shares_;
    begin_nearest();
    improve();
    return times_s_[longest()] < along_tour_s ? shares_ : along_tour;
  }

 private:
  void begin_nearest() {
    for (Order& share : shares_) share.clear();
    for (std::size_t p = 0; p < points_W_.size(); ++p) {
      std::size_t best = 0;
      for (std::size_t m = 1; m < starts_W_.size(); ++m) {
        if ((starts_W_[m] - points_W_[p]).norm() < (starts_W_[best] - points_W_[p]).norm()) best = m;
      }
      shares_[best].push_back(p);
    }
    order_all();
  }

  /// One tour through all points, cut into equal lengths; each piece goes to the nearest MAV that has none yet.
  void begin_along_tour() {
    for (Order& share : shares_) share.clear();
    const Order tour = open_tour(starts_W_.front(), points_W_);
    const double piece_m = tour_length_m(starts_W_.front(), points_W_, tour) / static_cast<double>(starts_W_.size());
    std::vector<Order> pieces(starts_W_.size());
    double way_m = 0.0;
    for (std::size_t i = 0; i < tour.size(); ++i) {
      const std::size_t piece = piece_m > 0.0 ? static_cast<std::size_t>(way_m / piece_m) : 0;
      pieces[std::min(piece, pieces.size() - 1)].push_back(tour[i]);
      if (i + 1 < tour.size()) way_m += (points_W_[tour[i + 1]] - points_W_[tour[i]]).norm();
    }
    std::vector<bool> taken(starts_W_.size(), false);
    for (const Order& piece : pieces) {
      const std::size_t mav = nearest_free(piece, taken);
      taken[mav] = true;
      shares_[mav] = piece;
    }
    order_all();
  }

  [[nodiscard]] std::size_t nearest_free(const Order& piece, const std::vector<bool>& taken) const {
    std::size_t best = starts_W_.size();
    double best_m = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < starts_W_.size(); ++m) {
      double near_m = 1e300;
      for (const std::size_t p : piece) near_m = std::min(near_m, (starts_W_[m] - points_W_[p]).norm());
      if (!taken[m] && near_m < best_m) best = m, best_m = near_m;
    }
    return best;
  }

  void order_all() {
    for (std::size_t m = 0; m < shares_.size(); ++m) {
      set(m, shares_[m]);
      order(m);
    }
  }

  void set(std::size_t mav, Order share) {
    times_s_[mav] = flight_time_s(starts_W_[mav], points_W_, share, limits_);
    ordered_[mav] = false;
    shares_[mav] = std::move(share);
  }

  /// In the better of two orders: as it is, or as a tour.
  void order(std::size_t mav) {
    if (ordered_[mav]) return;
    std::vector<Eigen::Vector3d> places_W;
    for (const std::size_t p : shares_[mav]) places_W.push_back(points_W_[p]);
    Order toured;
    for (const std::size_t i : open_tour(starts_W_[mav], places_W)) toured.push_back(shares_[mav][i]);
    const Order as_it_was = shares_[mav];
    const double as_it_was_s = times_s_[mav];
    set(mav, std::move(toured));
    if (times_s_[mav] > as_it_was_s) set(mav, as_it_was);
    ordered_[mav] = true;
  }

  [[nodiscard]] std::size_t longest() const {
    return static_cast<std::size_t>(std::max_element(times_s_.begin(), times_s_.end()) - times_s_.begin());
  }

  /// New orders are only worth their time once the moves have come to an end; they may make room for others.
  void improve() {
    double before_s = 0.0;
    do {
      before_s = times_s_[longest()];
      while (give_away() || swap()) {
      }
      for (std::size_t m = 0; m < shares_.size(); ++m) order(m);
    } while (times_s_[longest()] < (1.0 - kGain) * before_s);
  }

  /// A place in a MAV's way, counted from its start.
  [[nodiscard]] const Eigen::Vector3d& place(std::size_t mav, std::size_t i) const {
    return i == 0 ? starts_W_[mav] : points_W_[shares_[mav][i - 1]];
  }

  /// What the way is shorter without its i-th point, m.
  [[nodiscard]] double saved_m(std::size_t mav, std::size_t i) const {
    const Eigen::Vector3d& p_W = place(mav, i + 1);
    const double before_m = (p_W - place(mav, i)).norm();
    if (i + 1 == shares_[mav].size()) return before_m;
    return before_m + (place(mav, i + 2) - p_W).norm() - (place(mav, i + 2) - place(mav, i)).norm();
  }

  struct Gap {
    std::size_t i = 0;
    double detour_m = std::numeric_limits<double>::infinity();
  };

  /// Where a point makes the way least longer.
  [[nodiscard]] Gap best_gap(std::size_t mav, const Eigen::Vector3d& p_W) const {
    Gap best;
    for (std::size_t i = 0; i <= shares_[mav].size(); ++i) {
      double detour_m = (p_W - place(mav, i)).norm();
      if (i < shares_[mav].size()) {
        detour_m += (place(mav, i + 1) - p_W).norm() - (place(mav, i + 1) - place(mav, i)).norm();
      }
      if (detour_m < best.detour_m) best = {i, detour_m};
    }
    return best;
  }

  /// The longest flight gives its i-th point to another MAV and takes that one's k-th, or none.
  struct Change {
    std::size_t i = 0, mav = 0;
    std::optional<std::size_t> k;
    double longer_s = 0.0;  ///< of the two, about
  };

  /// The changes that look best are tried; the first that helps is made.
  bool make_best(std::vector<Change> changes) {
    const std::size_t from = longest();
    const std::size_t n = std::min(kTried, changes.size());
    std::partial_sort(changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(n), changes.end(),
                      [](const Change& a, const Change& b) { return a.longer_s < b.longer_s; });
    for (std::size_t c = 0; c < n && changes[c].longer_s < times_s_[from]; ++c) {
      if (try_change(from, changes[c])) return true;
    }
    return false;
  }

  bool try_change(std::size_t from, const Change& change) {
    const Order from_share = shares_[from], to_share = shares_[change.mav];
    const double from_s = times_s_[from], to_s = times_s_[change.mav];
    const std::size_t given = from_share[change.i];
    shares_[from].erase(shares_[from].begin() + static_cast<std::ptrdiff_t>(change.i));
    if (change.k) {
      shares_[change.mav].erase(shares_[change.mav].begin() + static_cast<std::ptrdiff_t>(*change.k));
      insert(from, to_share[*change.k]);
    }
    insert(change.mav, given);
    set(from, shares_[from]);
    set(change.mav, shares_[change.mav]);
    if (std::max(times_s_[from], times_s_[change.mav]) < (1.0 - kGain) * from_s) return true;
    shares_[from] = from_share, shares_[change.mav] = to_share;
    times_s_[from] = from_s, times_s_[change.mav] = to_s;
    return false;
  }

  void insert(std::size_t mav, std::size_t point) {
    const std::size_t i = best_gap(mav, points_W_[point]).i;
    shares_[mav].insert(shares_[mav].begin() + static_cast<std::ptrdiff_t>(i), point);
  }

  [[nodiscard]] double seconds_per_m() const {
    const std::size_t from = longest();
    const double way_m = tour_length_m(starts_W_[from], points_W_, shares_[from]);
    return way_m > 0.0 ? times_s_[from] / way_m : 0.0;
  }

  bool give_away() {
    const std::size_t from = longest();
    const double s_per_m = seconds_per_m();
    std::vector<Change> changes;
    for (std::size_t i = 0; i < shares_[from].size(); ++i) {
      const double shorter_s = times_s_[from] - s_per_m * saved_m(from, i);
      for (std::size_t m = 0; m < shares_.size(); ++m) {
        if (m == from) continue;
        const double longer_s = times_s_[m] + s_per_m * best_gap(m, place(from, i + 1)).detour_m;
        changes.push_back({i, m, std::nullopt, std::max(shorter_s, longer_s)});
      }
    }
    return make_best(std::move(changes));
  }

  bool swap() {
    const std::size_t from = longest();
    const double s_per_m = seconds_per_m();
    std::vector<Change> changes;
    for (std::size_t m = 0; m < shares_.size(); ++m) {
      if (m == from) continue;
      std::vector<double> back_s;
      for (std::size_t k = 0; k < shares_[m].size(); ++k) {
        back_s.push_back(s_per_m * best_gap(from, place(m, k + 1)).detour_m);
      }
      for (std::size_t i = 0; i < shares_[from].size(); ++i) {
        const double shorter_s = times_s_[from] - s_per_m * saved_m(from, i);
        const double longer_s = times_s_[m] + s_per_m * best_gap(m, place(from, i + 1)).detour_m;
        for (std::size_t k = 0; k < shares_[m].size(); ++k) {
          changes.push_back({i, m, k, std::max(shorter_s + back_s[k], longer_s - s_per_m * saved_m(m, k))});
        }
      }
    }
    return make_best(std::move(changes));
  }

  Places starts_W_, points_W_;
  MotionLimits limits_;
  std::vector<Order> shares_;
  std::vector<double> times_s_;
  std::vector<bool> ordered_;  ///< shares whose order has been looked at
};

}  // namespace

double flight_time_s(const Eigen::Vector3d& start_W, Places points_W, std::span<const std::size_t> order,
                     const MotionLimits& limits) {
  std::vector<Waypoint> waypoints;
  for (const std::size_t i : order) waypoints.push_back({.p_W = points_W[i]});
  return Trajectory(start_W, Eigen::Vector3d::Zero(), waypoints, limits).duration_s();
}

std::vector<Order> share_by_time(Places starts_W, Places points_W, const MotionLimits& limits) {
  if (starts_W.empty() || points_W.empty()) return std::vector<Order>(starts_W.size());
  return Sharing(starts_W, points_W, limits).run();
}

}  // namespace comptonaut
