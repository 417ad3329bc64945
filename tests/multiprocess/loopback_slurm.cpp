#include "loopback_slurm.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/socket.h>

#include <fstream>

#include <fmt/format.h>

#include "base/files.hpp"
#include "program.hpp"
#include "runtime/process.hpp"

namespace nacre::test {
namespace {

namespace fs = std::filesystem;

/// A TCP port that nobody listens on now.
int free_port() {
  const int socket_fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  int port = 0;
  if (::bind(socket_fd, reinterpret_cast<sockaddr*>(&address), length) == 0 &&
      ::getsockname(socket_fd, reinterpret_cast<sockaddr*>(&address), &length) == 0) {
    port = ntohs(address.sin_port);
  }
  ::close(socket_fd);
  return port;
}

std::string user() {
  const passwd* entry = ::getpwuid(::getuid());
  return entry == nullptr ? std::to_string(::getuid()) : entry->pw_name;
}

constexpr const char* kConfiguration = R"(ClusterName=nacretest
SlurmctldHost=localhost(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controller_port}
SlurmdPort={node_port}
AuthType=auth/none
CredType=cred/none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/controller.pid
SlurmdPidFile={folder}/node.pid
SlurmctldLogFile={folder}/controller.log
SlurmdLogFile={folder}/node.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=sched_min_interval=1000,batch_sched_delay=0,bf_interval=1
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
SlurmdTimeout=10
MessageTimeout=5
MinJobAge=10
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=farm Nodes=localhost Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
)";

}  // namespace

LoopbackSlurm::LoopbackSlurm(const fs::path& folder) : folder_(folder) {
  for (const char* part : {"state", "spool"}) fs::create_directories(folder_ / part);
  std::ofstream(folder_ / "slurm.conf") << fmt::format(
      kConfiguration, fmt::arg("user", user()), fmt::arg("folder", folder_.string()),
      fmt::arg("controller_port", free_port()), fmt::arg("node_port", free_port()));
  ::setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
  if (runtime::ask_program({"slurmctld", "-V"}).end.exit_status != 0) {
    reason_ = "slurmctld is not installed (package slurm-wlm)";
    return;
  }
  start_controller(true);
  start_node();
  if (becomes_ready(20.0)) return;
  reason_ = "the loopback cluster does not start: " + runtime::ask_program({"sinfo", "-N", "-l"}).output;
  for (const char* log : {"controller.err", "node.err"}) {
    if (fs::exists(folder_ / log)) reason_ += read_file(folder_ / log);
  }
}

LoopbackSlurm::~LoopbackSlurm() {
  node_.reset();
  controller_.reset();
  ::unsetenv("SLURM_CONF");
}

void LoopbackSlurm::kill_controller() { controller_.reset(); }
void LoopbackSlurm::kill_node() { node_.reset(); }

void LoopbackSlurm::start_controller(bool clean) {
  std::vector<std::string> command = {"slurmctld", "-D", "-f", (folder_ / "slurm.conf").string()};
  if (clean) command.push_back("-c");
  controller_ = std::make_unique<Process>(command, folder_ / "controller.err");
}

void LoopbackSlurm::start_node() {
  node_ = std::make_unique<Process>(
      std::vector<std::string>{"slurmd", "-D", "-N", "localhost", "-f", (folder_ / "slurm.conf").string()},
      folder_ / "node.err");
}

void LoopbackSlurm::mend_node() {
  const auto now = std::chrono::steady_clock::now();
  if (now - mended_ < std::chrono::seconds(1)) return;
  mended_ = now;
  const std::string state = runtime::ask_program({"sinfo", "--noheader", "--format=%t"}).output;
  if (!state.starts_with("drain") && !state.starts_with("drng") && !state.starts_with("down")) return;
  runtime::ask_program({"scontrol", "update", "nodename=localhost", "state=resume"});
}

bool LoopbackSlurm::becomes_ready(double timeout_s) {
  if (!controller_) start_controller();
  if (!node_) start_node();
  return becomes_true(
      [&] {
        mend_node();
        const std::string state = runtime::ask_program({"sinfo", "--noheader", "--format=%t"}).output;
        ::usleep(100'000);
        return state.starts_with("idle") || state.starts_with("mix") || state.starts_with("alloc");
      },
      timeout_s);
}

std::string LoopbackSlurm::standing() const {
  return runtime::ask_program({"sinfo", "-R"}).output + runtime::ask_program({"sinfo", "-N", "-l"}).output +
         runtime::ask_program({"squeue", "-a"}).output;
}

}  // namespace nacre::test
