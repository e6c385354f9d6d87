#include <fstream>

#include <nlohmann/json.hpp>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "experiments/experiment_page/page_parts.h"
#include "experiments/tables/paper_numbers.h"

namespace relight {

void write_description(const std::filesystem::path& folder, const ExperimentDescription& description) {
  std::vector<std::string> numbers;
  for (const std::filesystem::path& file : description.paper_numbers) {
    tables::read_paper_numbers(file);  // refuses what cannot be read before hours are spent
    std::filesystem::create_directories(folder / "paper_numbers");
    std::filesystem::copy_file(file, folder / "paper_numbers" / file.filename(),
                               std::filesystem::copy_options::overwrite_existing);
    numbers.push_back(file.filename().string());
  }
  const nlohmann::ordered_json json = {{"name", description.name},
                                       {"title", description.title},
                                       {"left_out", description.left_out},
                                       {"paper_numbers", numbers}};
  write_text_atomically(folder / "experiment.json",
                        json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

bool is_experiment_folder(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "experiment.json") || std::filesystem::exists(folder / "table.csv");
}

namespace page {

ExperimentDescription read_description(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "experiment.json";
  const std::string name = std::filesystem::absolute(folder / ".").parent_path().filename().string();
  if (!std::filesystem::exists(file)) return {name, name, {}, {}};
  std::ifstream in(file);
  try {
    const auto json = nlohmann::json::parse(in);
    const std::vector<std::string> names = json.value("paper_numbers", std::vector<std::string>{});
    ExperimentDescription read{json.at("name"), json.at("title"), json.at("left_out"), {}};
    for (const std::string& numbers : names) read.paper_numbers.push_back(folder / "paper_numbers" / numbers);
    return read;
  } catch (const nlohmann::json::exception& error) {
    fail("{}: {}", file.string(), error.what());
  }
}

}  // namespace page
}  // namespace relight
