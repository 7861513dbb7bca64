// SPDX-License-Identifier: BSD-3-Clause
#include "flight/envelope.h"

#include <ccd/ccd.h>

namespace comptonaut {
namespace {

Eigen::Vector3d from_ccd(const ccd_vec3_t& v) { return {v.v[0], v.v[1], v.v[2]}; }

void to_ccd(const Eigen::Vector3d& from, ccd_vec3_t* to) { ccdVec3Set(to, from.x(), from.y(), from.z()); }

/// A convex body as libccd wants it: the point that lies farthest in a direction, and a point inside.
class Convex {
 public:
  virtual ~Convex() = default;
  [[nodiscard]] virtual Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const = 0;
  [[nodiscard]] virtual Eigen::Vector3d centre() const = 0;
};

class ConvexBox : public Convex {
 public:
  explicit ConvexBox(const Box& box) : box_(box) {}
  [[nodiscard]] Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const override {
    return (direction.array() > 0.0).select(box_.max_W, box_.min_W);
  }
  [[nodiscard]] Eigen::Vector3d centre() const override { return 0.5 * (box_.min_W + box_.max_W); }

 private:
  Box box_;
};

class ConvexLeg : public Convex {
 public:
  explicit ConvexLeg(const Leg& leg) : leg_(leg) {}
  [[nodiscard]] Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const override {
    return direction.dot(leg_.to_W - leg_.from_W) > 0.0 ? leg_.to_W : leg_.from_W;
  }
  [[nodiscard]] Eigen::Vector3d centre() const override { return 0.5 * (leg_.from_W + leg_.to_W); }

 private:
  Leg leg_;
};

/// What an ellipsoid covers along a leg.
class Sweep : public Convex {
 public:
  Sweep(const Envelope& envelope, const Leg& leg)
      : leg_(leg),
        axes_(Eigen::Vector3d(envelope.radius_m, envelope.radius_m, envelope.half_height_m).array() +
              kCollisionTolerance_m) {}
  [[nodiscard]] Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const override {
    const Eigen::Vector3d scaled = axes_.cwiseProduct(direction);
    return leg_.farthest(direction) + axes_.cwiseProduct(scaled) / scaled.norm();
  }
  [[nodiscard]] Eigen::Vector3d centre() const override { return leg_.centre(); }

 private:
  ConvexLeg leg_;
  Eigen::Vector3d axes_;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  to_ccd(static_cast<const Convex*>(object)->farthest(from_ccd(*direction)), result);
}

void centre(const void* object, ccd_vec3_t* result) { to_ccd(static_cast<const Convex*>(object)->centre(), result); }

// Minkowski portal refinement [Snethen 2008]: for bodies with round sides it ends at its tolerance, where GJK may not.
bool meet(const Convex& a, const Convex& b) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support;
  ccd.support2 = support;
  ccd.center1 = centre;
  ccd.center2 = centre;
  ccd.mpr_tolerance = 0.1 * kCollisionTolerance_m;
  return ccdMPRIntersect(&a, &b, &ccd) != 0;
}

}  // namespace

Box bounds(const Envelope& envelope, const Leg& leg) {
  const Eigen::Vector3d reach =
      Eigen::Vector3d(envelope.radius_m, envelope.radius_m, envelope.half_height_m).array() + kCollisionTolerance_m;
  return {.min_W = leg.from_W.cwiseMin(leg.to_W) - reach, .max_W = leg.from_W.cwiseMax(leg.to_W) + reach};
}

bool sweep_meets(const Envelope& envelope, const Leg& leg, const Box& box) {
  const Box swept = bounds(envelope, leg);
  if (!swept.touches(box)) return false;
  // Only that part of the box matters; so vast boxes cost no precision.
  const Box part{.min_W = box.min_W.cwiseMax(swept.min_W), .max_W = box.max_W.cwiseMin(swept.max_W)};
  return meet(Sweep(envelope, leg), ConvexBox(part));
}

bool sweep_meets(const Envelope& envelope, const Leg& a, const Leg& b) {
  const Box other{.min_W = b.from_W.cwiseMin(b.to_W), .max_W = b.from_W.cwiseMax(b.to_W)};
  return bounds(envelope, a).touches(other) && meet(Sweep(envelope, a), ConvexLeg(b));
}

}  // namespace comptonaut
