#include "methods/clustered_gather/hard_cases/hard_cases.h"

#include "common/hard_cases/scale_case.h"
#include "methods/clustered_gather/clustered_gather.h"

namespace relight::clustered_gather {

hard::Cases hard_cases() {
  hard::Cases all;
  for (const auto& part : {cluster_cases(), view_cases(), light_cases()})
    all.insert(all.end(), part.begin(), part.end());
  all.push_back(hard::scale_case(
      make_clustered_gather,
      {{"view_clusters", "200"}, {"directions", "100"}, {"gather_clusters", "16"}, {"device", "cpu"}}, 0.02,
      "stated: clusters are chosen by comparisons of floats, a few of which fall otherwise"));
  return all;
}

}  // namespace relight::clustered_gather
