// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace comptonaut {

/// lib/report/page/page.html with its style and scripts, and the mark {{data}} for the mission. Made at build time.
extern const char* const kPageText;

/// lib/report/page/comparison.html likewise, for a campaign.
extern const char* const kComparisonText;

}  // namespace comptonaut
