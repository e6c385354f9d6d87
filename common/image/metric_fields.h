// The metrics by name: the one list for records, tables and comparisons.
#pragma once

#include <utility>

#include "common/image/metrics.h"

namespace relight {

inline constexpr std::pair<const char*, double MetricSet::*> metric_fields[] = {
    {"relative", &MetricSet::relative},
    {"relative_edges_out", &MetricSet::relative_edges_out},
    {"relative_hdr", &MetricSet::relative_hdr},
    {"rmse", &MetricSet::rmse},
    {"relmse", &MetricSet::relmse},
    {"bias", &MetricSet::bias},
    {"ssim", &MetricSet::ssim},
    {"max", &MetricSet::max}};

}  // namespace relight
