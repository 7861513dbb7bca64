// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <comptonaut/msg/basis_t.hpp>
#include <comptonaut/msg/batch_key_t.hpp>
#include <comptonaut/msg/channel_counts_t.hpp>
#include <optional>

#include "core/batch_key.h"
#include "detector/event_batch.h"

namespace comptonaut {

/// Parts that several messages share.

[[nodiscard]] msg::batch_key_t to_msg(const BatchKey& key);
[[nodiscard]] std::optional<BatchKey> from_msg(const msg::batch_key_t& m);

[[nodiscard]] msg::basis_t to_msg(const Basis& basis);
[[nodiscard]] std::optional<Basis> from_msg(const msg::basis_t& m);

[[nodiscard]] msg::channel_counts_t to_msg(const ChannelCounts& counts);
[[nodiscard]] std::optional<ChannelCounts> from_msg(const msg::channel_counts_t& m);

}  // namespace comptonaut
