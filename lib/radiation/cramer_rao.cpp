// SPDX-License-Identifier: BSD-3-Clause
#include "radiation/cramer_rao.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "radiation/sight_lines.h"

namespace comptonaut {
namespace {

constexpr double kWide = 1e9;  // such a prior says nothing

JointConfig without_priors(JointConfig config) {
  config.response_rel_sigma = config.scatter_share_sigma = kWide;
  return config;
}

std::size_t channel_of(const std::vector<JointChannel>& channels, const PointSource& source) {
  const auto at = std::ranges::find(channels, source.nuclide, &JointChannel::nuclide);
  return at == channels.end() ? 0 : static_cast<std::size_t>(at - channels.begin());
}

JointData no_data(const std::vector<int>& mavs, const World& world) {
  JointData data;
  data.senders.assign(mavs.begin(), mavs.end());
  data.live_s.assign(mavs.size(), 0.0);
  data.R_ND.assign(mavs.size(), Eigen::Matrix3d::Identity());
  if (!world.is_flat()) data.sight = std::make_shared<SightLines>(world);
  return data;
}

}  // namespace

CramerRao::CramerRao(std::vector<JointChannel> channels, const std::vector<PointSource>& truth,
                     const std::vector<int>& mavs, const World& world)
    : sources_(truth.size()) {
  for (std::size_t c = 0; c < channels.size(); ++c) {
    Channel channel{.of = channels[c], .sources = {}, .truth = {}, .data = no_data(mavs, world), .information = {}};
    const auto add = [&](bool own) {
      for (std::size_t k = 0; k < truth.size(); ++k) {
        const std::size_t at = channel_of(channels, truth[k]);
        if (own ? at != c : at <= c) continue;
        channel.sources.push_back(k);
        channel.truth.sources.push_back(truth[k]);
        if (own) continue;
        channel.truth.known.push_back({.other = at - c - 1, .source = truth[k], .activity_rel_sigma = kWide});
      }
    };
    add(false);
    add(true);
    channel.truth.drones.resize(mavs.size());
    channel.truth.scatter = 1.0 + channel.of.config.scatter_share;
    channel.information = channel.information_of_data(without_priors(channel.of.config));
    channels_.push_back(std::move(channel));
  }
}

void CramerRao::add(const MeasurementBatch& batch) {
  for (Channel& channel : channels_) comptonaut::add(channel.data, batch, channel.of.nuclide);
}

ParameterLayout CramerRao::Channel::layout() const {
  return {.sources = truth.sources.size(), .drones = truth.drones.size(), .movable = all_of(truth.sources.size())};
}

Eigen::MatrixXd CramerRao::Channel::information_of_data(const JointConfig& config) const {
  const JointProblem problem{.config = config, .physics = of.physics, .data = data};
  return linearise(problem, state_of(problem, truth), layout()).information;
}

void CramerRao::Channel::fold() {
  information += information_of_data(without_priors(of.config));
  data.viewpoints = {};
  data.pairs.clear();
  if (data.sight) data.sight = std::make_shared<SightLines>(data.sight->world());
}

Eigen::MatrixXd CramerRao::total() const {
  const ParameterLayout shared{.sources = sources_, .drones = 0, .movable = all_of(sources_)};
  Eigen::Index size = static_cast<Eigen::Index>(shared.log_singles(0));
  std::vector<std::vector<Eigen::Index>> places;  // of each channel's parameters in the whole
  struct Link {
    std::size_t activity;
    Eigen::Index here;
    double rel_sigma;
  };
  std::vector<Link> links;  // what a source leaves in another channel, to its activity
  for (const Channel& channel : channels_) {
    const ParameterLayout layout = channel.layout();
    std::vector<Eigen::Index>& place = places.emplace_back(layout.size());
    for (std::size_t k = 0; k < layout.sources; ++k) {
      const std::size_t source = channel.sources[k];
      const bool known = k < channel.truth.known.size();
      if (known) links.push_back({shared.log_activity(source), size, channel.of.config.known_rel_sigma});
      place[layout.log_activity(k)] = known ? size++ : static_cast<Eigen::Index>(shared.log_activity(source));
      place[layout.x_m(k)] = static_cast<Eigen::Index>(shared.x_m(source));
      place[layout.x_m(k) + 1] = place[layout.x_m(k)] + 1;
    }
    for (std::size_t i = layout.log_singles(0); i < layout.size(); ++i) place[i] = size++;
  }
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    total(places[c], places[c]) += channels_[c].information + channels_[c].information_of_data(channels_[c].of.config);
  }
  for (const auto& [activity, here, rel_sigma] : links) {
    const auto of = static_cast<Eigen::Index>(activity);
    const double weight = 1.0 / (rel_sigma * rel_sigma);
    total(of, of) += weight, total(here, here) += weight;
    total(of, here) -= weight, total(here, of) -= weight;
  }
  return total;
}

double CramerRao::rmse_m() {
  for (Channel& channel : channels_) channel.fold();
  Eigen::MatrixXd information = total();
  information.diagonal().array() += 1e-9;
  const Eigen::MatrixXd covariance = information.inverse();
  double sum_m2 = 0.0;
  for (std::size_t k = 0; k < sources_; ++k) {
    const auto x = static_cast<Eigen::Index>(sources_ + 2 * k);
    sum_m2 += covariance(x, x) + covariance(x + 1, x + 1);
  }
  return sources_ > 0 ? std::sqrt(sum_m2 / static_cast<double>(sources_)) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace comptonaut
