#include "simulator_farm/slurm_executor.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "base/files.hpp"
#include "base/hash.hpp"
#include "runtime/bus.hpp"
#include "simulator_farm/batch_file.hpp"
#include "simulator_farm/simulate_work.hpp"

namespace nacre::simulator_farm {
namespace {

namespace fs = std::filesystem;
using runtime::LogLevel;

constexpr std::size_t kMostTests = 500;  // of a batch
constexpr std::size_t kMostTasks = 500;  // of a wave; Slurm's own limit (MaxArraySize) is 1001 as shipped
constexpr int kAttemptsTogether = 2;     // then each test of a lost batch goes by itself
constexpr auto kTurn = std::chrono::milliseconds(100);

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "nothing";
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin + 1, end - begin);
}

/// Worth a line: the first few, then rarely.
bool is_worth_a_line(int count) { return std::has_single_bit(static_cast<unsigned>(count)); }

}  // namespace

SlurmExecutor::SlurmExecutor(std::shared_ptr<store::SimulationCache> cache, SlurmSettings settings,
                             std::function<void()> wake)
    : outbox_(std::move(wake)), cache_(std::move(cache)), settings_(std::move(settings)), spool_(settings_.spool) {
  // Names of jobs are how tasks are found again: no other run's, and never used twice.
  job_prefix_ =
      fmt::format("nacre-{}-{:x}-", content_hash(fs::weakly_canonical(settings_.spool).string()).substr(0, 10),
                  runtime::now_utime() / 1000);
  adopt_spool();
  thread_ = std::thread([this] { run(); });
}

SlurmExecutor::~SlurmExecutor() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

// ---- The shell's side ----

void SlurmExecutor::start(runtime::Compute compute) {
  outbox_.expect_one();
  const std::lock_guard lock(mutex_);
  new_.push_back(std::move(compute));
  changed_.notify_all();
}

// ---- The executor's own thread ----

double SlurmExecutor::now_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The node cannot go on: any of the works that are open carries the reason.
void SlurmExecutor::give_up(const std::string& reason) {
  outbox_.finish({.id = "slurm", .kind = "simulate", .spec = ""}, fail("{}", reason));
}

void SlurmExecutor::run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    try {
      turn();
    } catch (const std::exception& problem) {
      give_up(problem.what());
      return;
    }
    outbox_.set_standing(
        fmt::format("slurm: {} tests wait, {} batches are out; {} tasks so far, {} lost, {} duplicates",
                    waiting_.size(), in_flight_.size(), counters_.tasks, counters_.lost, counters_.duplicates));
    lock.lock();
    if (new_.empty() && !stopping_) changed_.wait_for(lock, kTurn);
  }
}

void SlurmExecutor::turn() {
  take_new();
  take_results();
  look_at_slurm();
  cut_batches();
  submit();
}

/// What the farm before this one gave out and did not get back.
void SlurmExecutor::adopt_spool() {
  spool_.tidy();
  const auto tasks = spool_.tasks();
  for (const std::string& name : spool_.batches()) {
    const auto batch = read_batch(read_file(spool_.batch_file(name)));
    if (!batch) {  // of another version: its result would not be taken either
      spool_.remove(name);
      continue;
    }
    InFlight& entry = in_flight_.emplace(name, InFlight{{}, {}, BatchWatch(now_s())}).first->second;
    for (const std::string& spec : batch->specs) {
      entry.tests.push_back({.spec = spec, .compute = std::nullopt});
      batch_of_spec_[spec] = name;
    }
    const auto given = tasks.find(name);
    if (given != tasks.end()) entry.tasks = given->second;
    if (entry.tasks.empty()) to_submit_.push_back(name);
  }
  if (!in_flight_.empty()) {
    outbox_.say(LogLevel::info,
                fmt::format("{} batches that were given to Slurm before are waited for", in_flight_.size()));
  }
}

void SlurmExecutor::take_new() {
  std::deque<runtime::Compute> taken;
  {
    const std::lock_guard lock(mutex_);
    taken = std::exchange(new_, {});
  }
  for (runtime::Compute& compute : taken) {
    std::string spec = compute.spec;
    sort_test({.spec = std::move(spec), .compute = std::move(compute)});
  }
}

/// Done at once, or out already, or to go out.
void SlurmExecutor::sort_test(OpenTest open_test) {
  if (is_known(*cache_, settings_.films, asked_in(open_test.spec))) {
    if (open_test.compute) respond(*open_test.compute);
    return;
  }
  if (const auto out = batch_of_spec_.find(open_test.spec); out != batch_of_spec_.end()) {
    for (OpenTest& other : in_flight_.at(out->second).tests) {
      if (other.spec == open_test.spec && !other.compute) {
        other.compute = std::move(open_test.compute);
        return;
      }
    }
  }
  if (waiting_.empty()) waiting_since_s_ = now_s();
  waiting_.push_back(std::move(open_test));
}

void SlurmExecutor::respond(const runtime::Compute& compute) {
  outbox_.finish(compute, simulate_work(*cache_, settings_.films, compute.spec));
}

void SlurmExecutor::take_results() {
  for (const std::string& name : spool_.results()) {
    if (in_flight_.contains(name)) {
      take_result(name);
    } else {
      ++counters_.duplicates;
      spool_.remove(name);
    }
  }
}

void SlurmExecutor::take_result(const std::string& name) {
  const auto records = read_batch_result(read_file(spool_.result(name)), name);
  if (!records) {
    outbox_.say(LogLevel::warning,
                fmt::format("{}: {}; it is asked for again", spool_.result(name).string(), records.error().message));
    fs::remove(spool_.result(name));
    return give_again(name);
  }
  for (const BatchRecord& record : *records) {
    keep_response(*cache_, record.key, record.response, record.breaks ? &*record.breaks : nullptr);
  }
  InFlight entry = std::move(in_flight_.extract(name).mapped());
  for (std::size_t i = 0; i < entry.tests.size(); ++i) {
    const AskedSimulation asked = asked_in(entry.tests[i].spec);
    if (i < records->size()) costs_.learn(asked.test, asked.simulation.fidelity, (*records)[i].seconds);
    batch_of_spec_.erase(entry.tests[i].spec);
  }
  spool_.remove(name);
  std::erase(to_submit_, name);
  // Whatever has not come with it (a film that cannot be kept): asked again, a task would say the same for ever.
  for (const OpenTest& open_test : entry.tests) {
    if (open_test.compute) respond(*open_test.compute);
  }
  if (in_flight_.empty()) spool_.tidy();
}

// ---- What has become of the tasks ----

void SlurmExecutor::look_at_slurm() {
  if (listing_) {
    const auto said = listing_->poll(now_s());
    if (!said) return;
    listing_.reset();
    next_listing_s_ = now_s() + settings_.poll_s;
    if (said->end.orderly()) {
      silent_listings_ = 0;
      return take_listing(read_listing(said->output));
    }
    if (is_worth_a_line(++silent_listings_)) {
      outbox_.say(LogLevel::warning, fmt::format("Slurm does not tell how the tasks stand ({}); results are waited for",
                                                 last_line(said->output)));
    }
    return;
  }
  if (now_s() < next_listing_s_) return;
  std::set<std::string> waves;
  asked_batches_.clear();
  for (const auto& [name, entry] : in_flight_) {
    if (entry.tasks.empty()) continue;
    asked_batches_.insert(name);
    for (const Task& task : entry.tasks) waves.insert(task.first);
  }
  if (waves.empty()) return;
  listing_.emplace(listing({waves.begin(), waves.end()}), now_s());
}

void SlurmExecutor::take_listing(const Listing& tasks) {
  const double now = now_s();
  std::vector<std::string> lost;
  for (auto& [name, entry] : in_flight_) {
    if (!asked_batches_.contains(name)) continue;  // given out after the listing began
    TaskState state = TaskState::absent;
    for (const Task& task : entry.tasks) {
      const auto listed = tasks.find(task);
      if (listed == tasks.end() || state == TaskState::running) continue;
      if (state != TaskState::waiting || listed->second == TaskState::running) state = listed->second;
    }
    entry.watch.listed(state, now);
    entry.watch.sign(spool_.read_sign(name), now);
    const bool is_on_its_way = std::find(to_submit_.begin(), to_submit_.end(), name) != to_submit_.end();
    if (!is_on_its_way && entry.watch.is_lost(now, settings_.patience)) lost.push_back(name);
  }
  for (const std::string& name : lost) {
    if (fs::exists(spool_.result(name))) continue;  // it came meanwhile
    ++counters_.lost;
    if (is_worth_a_line(counters_.lost)) {
      outbox_.say(LogLevel::warning,
                  fmt::format("a task of batch {} gave no result (it last said: {}); it is given out again", name,
                              spool_.last_words(in_flight_.at(name).tasks)));
    }
    give_again(name);
  }
}

/// A lost batch goes out again as it is, with its file where that is gone; when that does not help, each of its tests
/// by itself.
void SlurmExecutor::give_again(const std::string& name) {
  InFlight& entry = in_flight_.at(name);
  int attempts = 0;
  for (OpenTest& open_test : entry.tests) attempts = std::max(attempts, ++open_test.attempts);
  if (entry.tests.size() == 1 && attempts >= settings_.most_attempts) {
    throw InputError::format(
        "a simulation was given to Slurm {} times and never came back; its task last said: {}. Logs and the batch "
        "stand "
        "in {}; mend the cluster and start the farm again",
        attempts, spool_.last_words(entry.tasks), spool_.folder().string());
  }
  if (entry.tests.size() == 1 || attempts < kAttemptsTogether) {
    spool_.put(name, batch_bytes(entry.tests));
    entry.watch = BatchWatch(now_s());
    to_submit_.push_back(name);
    return;
  }
  InFlight broken = std::move(in_flight_.extract(name).mapped());
  for (const OpenTest& open_test : broken.tests) batch_of_spec_.erase(open_test.spec);
  for (OpenTest& open_test : broken.tests) put_batch({std::move(open_test)});
  spool_.remove(name);
}

// ---- Giving out ----

void SlurmExecutor::cut_batches() {
  if (waiting_.empty() || now_s() < waiting_since_s_ + settings_.gather_s) return;
  std::vector<double> costs_s;
  for (const OpenTest& open_test : waiting_) {
    const AskedSimulation asked = asked_in(open_test.spec);
    costs_s.push_back(costs_.seconds(asked.test, asked.simulation.fidelity));
  }
  for (const std::size_t count : cut_into_batches(costs_s, settings_.batch_s, kMostTests)) {
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(count);
    put_batch({std::make_move_iterator(waiting_.begin()), std::make_move_iterator(end)});
    waiting_.erase(waiting_.begin(), end);
  }
}

std::string SlurmExecutor::batch_bytes(const std::vector<OpenTest>& tests) const {
  Batch batch{fs::absolute(settings_.films), {}};
  for (const OpenTest& open_test : tests) batch.specs.push_back(open_test.spec);
  return write_batch(batch);
}

/// On disk before it is submitted to Slurm.
void SlurmExecutor::put_batch(std::vector<OpenTest> tests) {
  const std::string bytes = batch_bytes(tests);
  const std::string name = batch_name(bytes);
  spool_.put(name, bytes);
  for (const OpenTest& open_test : tests) batch_of_spec_[open_test.spec] = name;
  if (const auto known = in_flight_.find(name); known != in_flight_.end()) {
    // On its way from before the farm was killed: whoever waits for it goes on waiting.
    for (std::size_t i = 0; i < tests.size(); ++i) {
      OpenTest& waited_for = known->second.tests.at(i);
      if (!waited_for.compute) waited_for.compute = std::move(tests[i].compute);
    }
    return;
  }
  in_flight_.emplace(name, InFlight{std::move(tests), {}, BatchWatch(now_s())});
  to_submit_.push_back(name);
}

void SlurmExecutor::submit() {
  if (submission_) {
    if (const auto said = submission_->command.poll(now_s())) take_submission(*said);
    return;
  }
  if (to_submit_.empty() || now_s() < next_submission_s_) return;
  std::vector<std::string> batches;
  for (; !to_submit_.empty() && batches.size() < kMostTasks; to_submit_.pop_front()) {
    if (in_flight_.contains(to_submit_.front())) batches.push_back(to_submit_.front());
  }
  if (batches.empty()) return;
  const std::string name = fmt::format("{}{:04}", job_prefix_, next_wave_++);
  spool_.put_wave(name, batches);
  const fs::path script = spool_.folder() / "task.sh";
  write_file_atomically(
      script, fmt::format("#!/bin/sh\nexec {} work --spool {} --wave \"$SLURM_JOB_NAME\" --task "
                          "\"$SLURM_ARRAY_TASK_ID\"\n",
                          shell_word(fs::absolute(settings_.program)), shell_word(fs::absolute(spool_.folder()))));
  const Wave wave{.name = name,
                  .tasks = static_cast<int>(batches.size()),
                  .script = script,
                  .folder = fs::absolute(spool_.folder()),
                  .options = settings_.options};
  RunningCommand command(submission(wave), now_s());
  submission_.emplace(Submission{name, std::move(batches), std::move(command)});
}

void SlurmExecutor::take_submission(const runtime::ProgramOutput& said) {
  const Submission given = std::move(*submission_);
  submission_.reset();
  // Also when it failed: a controller that fell silent may have taken the job. Its name is looked for with the others.
  for (std::size_t task = 0; task < given.batches.size(); ++task) {
    const auto entry = in_flight_.find(given.batches[task]);
    if (entry == in_flight_.end()) continue;
    entry->second.tasks.emplace_back(given.wave, static_cast<int>(task));
    entry->second.watch = BatchWatch(now_s());
  }
  if (said.end.orderly()) {
    refusals_ = 0;
    counters_.tasks += given.batches.size();
    next_listing_s_ = now_s() + settings_.poll_s;
    return;
  }
  next_submission_s_ = now_s() + back_off_s(++refusals_);
  to_submit_.insert(to_submit_.end(), given.batches.begin(), given.batches.end());
  if (is_worth_a_line(refusals_)) {
    outbox_.say(LogLevel::warning, fmt::format("Slurm does not take tasks ({}, {}); it is asked again in {:.0f} s",
                                               said.end.in_words(), last_line(said.output), back_off_s(refusals_)));
  }
}

}  // namespace nacre::simulator_farm
