// Every method of the testbed, by name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/run/method.h"

namespace relight {

using MethodList = std::vector<std::unique_ptr<Method>>;

// All registered methods, in the order in which tables and reports show them.
MethodList make_all_methods();

// Throws UsageError listing the valid names.
const Method& find_method(const MethodList& methods, const std::string& name);

}  // namespace relight
