#include "explore/batch_log.hpp"

#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/hash.hpp"
#include "base/result.hpp"
#include "explore/gamut_csv.hpp"
#include "pattern/pattern_key.hpp"

namespace nacre::explore {
namespace {

/// Everything that batches depend on, but for the budget: a finished search may be given more.
std::string identity_of(const SearchSettings& settings, const std::string& model) {
  const LearnedSettings& learned = settings.learned;
  const std::string samples = content_hash(to_csv(settings.known) + to_csv(settings.former));
  const bool learns = settings.algorithm == "learned";
  const Mechanics& known = settings.mechanics;
  const std::string cells = known.cell_modulus && known.cell_loads ? " cells=elastic"
                            : known.cell_modulus                   ? " cells=modulus"
                            : known.cell_loads                     ? " cells=loads"
                                                                   : "";
  return fmt::format("batches of {} seed={} population={} batch={} samples={} learned={}{}{}{}", settings.algorithm,
                     settings.seed, settings.population, settings.batch, samples, learns ? to_text(learned) : "-",
                     learns && known.modulus_of ? " modulus=exact" : "", learns ? cells : "",
                     model.empty() ? "" : " model=" + model);
}

std::vector<pattern::Pattern> batch_from(const std::string& line, const std::filesystem::path& path,
                                         std::size_t number) {
  std::vector<pattern::Pattern> batch;
  std::istringstream keys(line);
  for (std::string key; keys >> key;) {
    const Result<pattern::Pattern> pattern = pattern::pattern_from_key(key);
    if (!pattern)
      throw InputError::format("{}: line {}: \"{}\", expected the key of a pattern", path.string(), number, key);
    batch.push_back(*pattern);
  }
  if (batch.empty())
    throw InputError::format("{}: line {}: is empty, expected the keys of a batch", path.string(), number);
  return batch;
}

std::string line_of(const std::vector<pattern::Pattern>& batch) {
  std::string line;
  for (const pattern::Pattern& pattern : batch) line += (line.empty() ? "" : " ") + pattern.key();
  return line + "\n";
}

void append(const std::filesystem::path& path, const std::string& line) {
  std::ofstream file(path, std::ios::app);
  file << line << std::flush;
  if (!file) throw InputError::format("{}: cannot be written", path.string());
}

}  // namespace

BatchLog::BatchLog(std::filesystem::path path, const SearchSettings& settings, const std::string& model)
    : path_(std::move(path)), identity_(identity_of(settings, model)) {
  const std::string first = identity_ + "\n";
  std::string text = std::filesystem::exists(path_) ? read_file(path_) : "";
  if (first.starts_with(text) && text != first) {  // none yet, or its first line was cut off by a crash
    text = first;
    write_file_atomically(path_, text);
  }
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  if (line != identity_)
    throw InputError::format("{}: line 1: it is \"{}\", expected \"{}\"; name another file", path_.string(), line,
                             identity_);
  if (!text.ends_with('\n')) {
    text.resize(text.rfind('\n') + 1);
    write_file_atomically(path_, text);
    lines.str(text);
    std::getline(lines, line);
  }
  for (std::size_t number = 2; std::getline(lines, line); ++number) batches_.push_back(batch_from(line, path_, number));
}

std::vector<pattern::Pattern> BatchLog::ask(Search& search) {
  if (next_ == batches_.size()) {
    const std::vector<pattern::Pattern> batch = search.ask();
    if (!batch.empty()) append(path_, line_of(batch));
    return batch;
  }
  const std::vector<pattern::Pattern> batch = search.ask_with(batches_[next_]);
  if (batch.size() > batches_[next_].size()) fill_up(batch);
  ++next_;
  return batch;
}

void BatchLog::fill_up(const std::vector<pattern::Pattern>& batch) {
  batches_[next_] = batch;
  std::string text = identity_ + "\n";
  for (const auto& each : batches_) text += line_of(each);
  write_file_atomically(path_, text);
}

}  // namespace nacre::explore
