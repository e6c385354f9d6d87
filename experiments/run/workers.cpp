#include "experiments/run/workers.h"

#include <algorithm>
#include <csignal>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/run/error.h"
#include "common/run/thread_limit.h"

namespace relight {
namespace {

pid_t start(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  words.insert(words.begin(), "relight");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) fail("cannot start a worker process");
  if (child > 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before prctl
  execv("/proc/self/exe", pointers.data());
  _exit(127);
}

std::string why(int status) {
  if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
  return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

bool worked(int status) { return WIFEXITED(status) && WEXITSTATUS(status) <= 1; }

}  // namespace

std::vector<size_t> place_numbers(const RunList& list) {
  std::map<std::string, size_t> numbers;
  std::vector<size_t> out;
  for (const PlannedRun& run : list.runs) {
    const SessionOptions& s = run.plan.session;
    const std::string place = fmt::format("{}\n{}\n{}\n{}", s.scene, s.lights, s.view, s.seed);
    out.push_back(numbers.try_emplace(place, numbers.size()).first->second);
  }
  return out;
}

size_t number_of_places(const RunList& list) {
  const std::vector<size_t> numbers = place_numbers(list);
  return numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end()) + 1;
}

std::vector<std::string> worker_command(const RunOptions& options, const std::filesystem::path& out,
                                        size_t place) {
  const SessionOptions& session = options.session;
  const int cores = static_cast<int>(ThreadLimit::current());
  const int threads = session.threads > 0 ? session.threads : std::max(1, cores / options.jobs);
  std::vector<std::string> words = {"run",       options.experiment,      "--out",  out.string(),
                                    "--place",   std::to_string(place),   "--gpu",  session.gpu,
                                    "--threads", std::to_string(threads), "--quiet"};
  const auto add = [&](const char* option, const std::string& value) {
    words.push_back(option);
    words.push_back(value);
  };
  if (!options.only.empty()) add("--only", options.only);
  if (options.again) words.push_back("--again");
  if (options.time_limit_s >= 0.0) add("--time-limit", fmt::format("{}", options.time_limit_s));
  if (session.no_cache) words.push_back("--no-cache");
  if (!session.cache_folder.empty()) add("--cache", session.cache_folder);
  return words;
}

std::vector<std::string> run_workers(const std::vector<std::vector<std::string>>& commands, int jobs) {
  std::vector<std::string> failures;
  std::map<pid_t, size_t> running;
  const auto wait_for_one = [&] {
    int status = 0;
    const pid_t ended = waitpid(-1, &status, 0);
    const auto found = running.find(ended);
    if (found == running.end()) return;
    if (!worked(status))
      failures.push_back(
          fmt::format("`relight {}` {}", fmt::join(commands[found->second], " "), why(status)));
    running.erase(found);
  };
  for (size_t i = 0; i < commands.size(); ++i) {
    while (running.size() >= static_cast<size_t>(jobs)) wait_for_one();
    running[start(commands[i])] = i;
  }
  while (!running.empty()) wait_for_one();
  return failures;
}

}  // namespace relight
