// The list of methods: to add one, include its header and add its make function here.
#include "experiments/method_list.h"

#include "experiments/options/parse.h"
#include "experiments/usage_error.h"
#include "methods/clustered_gather/clustered_gather.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "reference/path_tracing_method.h"

namespace relight {

MethodList make_all_methods() {
  MethodList methods;
  methods.push_back(make_direct_to_indirect());
  methods.push_back(make_clustered_gather());
  methods.push_back(make_path_tracing());
  return methods;
}

const Method& find_method(const MethodList& methods, const std::string& name) {
  std::string valid;
  for (const auto& method : methods) {
    if (method->name() == name) return *method;
    append_name(valid, method->name());
  }
  usage_fail("unknown method '{}'; valid: {}", name, valid);
}

}  // namespace relight
