// The dashboard as a process: several runs behind one address, and what people are told when a node has their message
// and will not use it; that also of `nacre approve`.

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "program_test.hpp"
#include "runtime/bus.hpp"
#include "runtime/run_folder.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre {
namespace {

constexpr const char* kReason = "an APPROVAL changes nothing: soft is ordered already";

runtime::RunFolder new_run(const fs::path& logs, const std::string& name) {
  game::Scenario scenario;
  scenario.fidelity = tester::Fidelity::tiny;
  scenario.base_materials_file = scenario.discretisation_floor_file = "";
  return runtime::RunFolder::create(logs, name, scenario);
}

/// The nodes of a run that people's messages go to: they report, keep everything, and one of them refuses it.
class RefusingNodes {
 public:
  explicit RefusingNodes(const runtime::Manifest& run) {
    for (const char* node : {"validation_agent", "analyser"}) {
      runtime::BusOptions options;
      options.url = runtime::bus_url(run.port);
      options.node = node;
      options.run_id = run.run_id;
      buses_.push_back(runtime::Bus::open(options).value());
      EXPECT_TRUE(buses_.back()->subscribe({"APPROVAL", "MEASUREMENT", "REVIEW"}));
    }
    thread_ = std::thread([this] {
      for (int turn = 0; !stopping_; ++turn)
        for (std::size_t i = 0; i < buses_.size(); ++i) respond(*buses_[i], i == 0, turn % 20 == 0);
    });
  }
  ~RefusingNodes() {
    stopping_ = true;
    thread_.join();
  }

 private:
  static void respond(runtime::Bus& bus, bool refuses, bool reports) {
    wire::NodeStatus status;
    status.ready = true;
    status.journal = 1;
    if (reports) bus.publish({"STATUS", wire::write(status)});
    bus.receive(10, [&](const runtime::Received& received) {
      const std::string hash = wire::message_hash(received.message.channel, received.message.payload);
      wire::Ack ack{.journal = 1, .hashes = {hash}, .refused = {}};
      if (refuses) ack.refused.push_back({hash, kReason});
      bus.publish({"ACK", wire::write(ack)});
    });
  }

  std::vector<std::unique_ptr<runtime::Bus>> buses_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

/// A running `nacre dashboard`.
class Page {
 public:
  explicit Page(std::vector<std::string> runs) : process_(command(std::move(runs))) {
    if (!wait_until_said(process_, "shows ", said_)) throw InputError("the dashboard said: " + said_);
    const std::size_t colon = said_.find(':', said_.find("http://127.0.0.1") + 7);
    port_ = std::stoi(said_.substr(colon + 1));
  }

  const std::string& said() const { return said_; }
  nlohmann::json get(const std::string& path) const {
    return nlohmann::json::parse(
        body_of(fmt::format("GET {} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", path)));
  }
  nlohmann::json post(const std::string& path, const nlohmann::json& entry) const {
    const std::string body = entry.dump();
    return nlohmann::json::parse(
        body_of(fmt::format("POST {} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nX-Nacre: 1\r\nContent-Type: "
                            "application/json\r\nContent-Length: {}\r\n\r\n{}",
                            path, body.size(), body)));
  }

  /// Files as a browser sends them: part, file name, content.
  nlohmann::json post_files(const std::vector<std::array<std::string, 3>>& parts) const {
    std::string body;
    for (const auto& [part, file, content] : parts)
      body += fmt::format("--files\r\nContent-Disposition: form-data; name=\"{}\"{}\r\n\r\n{}\r\n", part,
                          file.empty() ? "" : fmt::format("; filename=\"{}\"", file), content);
    return nlohmann::json::parse(answer_to_files(body + "--files--\r\n"));
  }
  /// The same of a body that may be announced longer than it is.
  std::string answer_to_files(const std::string& body, std::size_t announced = 0) const {
    return body_of(
        fmt::format("POST /api/import HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nX-Nacre: 1\r\n"
                    "Content-Type: multipart/form-data; boundary=files\r\nContent-Length: {}\r\n\r\n{}",
                    std::max(announced, body.size()), body));
  }

 private:
  static std::vector<std::string> command(std::vector<std::string> runs) {
    runs.insert(runs.begin(), {program("nacre"), "dashboard"});
    runs.insert(runs.end(), {"--port", "0"});
    return runs;
  }
  std::string body_of(const std::string& request) const {
    const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string response;
    if (::connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
        ::send(connection, request.data(), request.size(), 0) == static_cast<ssize_t>(request.size())) {
      char some[4096];
      for (ssize_t count; (count = ::recv(connection, some, sizeof(some), 0)) > 0;)
        response.append(some, static_cast<std::size_t>(count));
    }
    ::close(connection);
    const std::size_t end = response.find("\r\n\r\n");
    return end == std::string::npos ? "" : response.substr(end + 4);
  }

  std::string said_;
  runtime::ChildProcess process_;
  int port_ = 0;
};

TEST(LateRefusals, AreSaidByApproveWithTheirReasonAndWhatToDo) {
  runtime::RunFolder run = new_run(fresh_folder("refused_approval"), "run");
  const runtime::PortReservation port(0);
  run.set_port(port.port());
  const RefusingNodes nodes(run.manifest());
  const Outcome outcome = run_nacre({"approve", "--add", "soft", "--run", run.path().string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr(kReason));
  EXPECT_THAT(outcome.err, HasSubstr("nacre designs"));
  EXPECT_THAT(outcome.out, IsEmpty()) << "nothing was added";
}

TEST(LateRefusals, AreSaidByTheDashboard) {
  runtime::RunFolder run = new_run(fresh_folder("refused_entry"), "run");
  const runtime::PortReservation port(0);
  run.set_port(port.port());
  const RefusingNodes nodes(run.manifest());
  const Page page({run.path().string()});
  ASSERT_TRUE(becomes_true([&] { return page.get("/api/live").at("playing").get<bool>(); }, 20.0));
  const nlohmann::json approved =
      page.post("/api/approval", {{"design", "soft"}, {"approved", true}, {"by", "Ada"}, {"why", "to try"}});
  EXPECT_EQ(approved.at("answer"), "refused") << approved;
  EXPECT_THAT(approved.at("error").get<std::string>(), AllOf(HasSubstr(kReason), HasSubstr("nacre designs")));
  const nlohmann::json measured = page.post(
      "/runs/run/api/measurement", {{"specimen", "a"}, {"pattern", "soft"}, {"test", "modulus"}, {"modulus_pa", 1e6}});
  EXPECT_EQ(measured.at("answer"), "refused") << measured;
  EXPECT_THAT(measured.at("error").get<std::string>(), AllOf(HasSubstr(kReason), HasSubstr("under a new name")));
}

/// A sheet of one row and the export that it names.
nlohmann::json import_of(const Page& page, const std::string& row, const std::string& export_text) {
  const std::string heading = "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm\n";
  return page.post_files({{"sheet", "specimens.csv", heading + row + "\n"}, {"export", "a.csv", export_text}});
}

std::string tutorial_export() { return read_file(fs::path(NACRE_SOURCE_DIR) / "data/examples/tester/tutorial-01.csv"); }

TEST(UploadedFiles, AreReadAsByNacreImport) {
  const Page page({new_run(fresh_folder("uploaded"), "run").path().string()});
  const nlohmann::json read = import_of(page, "a.csv,a,577fffe9fffdef,toughness,51.95,3.22,54", tutorial_export());
  ASSERT_EQ(read.value("specimens", nlohmann::json::array()).size(), 1U) << read;
  const nlohmann::json& specimen = read.at("specimens").at(0);
  EXPECT_EQ(specimen.at("specimen"), "a");
  EXPECT_GT(specimen.at("modulus_pa").get<double>(), 1e8);
  EXPECT_EQ(specimen.at("curve").at("strain").size(), specimen.at("curve").at("stress_pa").size());
  EXPECT_LE(specimen.at("curve").at("strain").size(), 60U);
  EXPECT_FALSE(read.contains("answers")) << "nothing was to be entered";
  const nlohmann::json thin = import_of(page, "a.csv,a,577fffe9fffdef,toughness,51.95,0.322,54", tutorial_export());
  EXPECT_THAT(thin.at("specimens").at(0).at("doubts").dump(), HasSubstr("are width_mm and thickness_mm right?"));
}

TEST(UploadedFiles, ReachNoFileOfThisMachine) {
  const Page page({new_run(fresh_folder("hostile"), "run").path().string()});
  const std::string layout = (fs::path(NACRE_SOURCE_DIR) / "data/patterns/published_a.txt").string();
  const auto reason = [&](const std::string& row) {
    const nlohmann::json read = import_of(page, row, tutorial_export());
    return read.at("rejected").dump();
  };
  EXPECT_THAT(reason(fmt::format("a.csv,a,{},toughness,52,3.2,54", layout)), HasSubstr("out of the sheet's folder"));
  EXPECT_THAT(reason("../../../etc/passwd,a,rigid,toughness,52,3.2,54"), HasSubstr("is not among the 1 exports"));
  EXPECT_THAT(page.post_files({{"sheet", "../specimens.csv", "file"}}).at("error").get<std::string>(),
              HasSubstr("without a path"));
}

TEST(UploadedFiles, AreLimitedAndLeaveTheServerAsItWas) {
  const Page page({new_run(fresh_folder("enormous"), "run").path().string()});
  EXPECT_THAT(page.answer_to_files("--files", 65u << 20), HasSubstr("at most 64 MB"));
  std::vector<std::array<std::string, 3>> many(600, {"export", "a.csv", ""});
  EXPECT_THAT(page.post_files(many).at("error").get<std::string>(), HasSubstr("too many"));
  EXPECT_THAT(page.answer_to_files("--nonsense\r\n\r\n\r\n--files--\r\n"), HasSubstr("error"));
  EXPECT_THAT(import_of(page, "a.csv,a,rigid,toughness,52,3.2,54", std::string(40u << 20, '1')).dump(),
              HasSubstr("expected at most 32 MB"));
  EXPECT_THAT(import_of(page, "a.csv,a,rigid,toughness,52,3.2,54", std::string(20u << 20, '"')).dump(),
              AllOf(HasSubstr("a.csv"), HasSubstr("expected")));
  EXPECT_FALSE(page.get("/api/live").at("playing").get<bool>());
}

TEST(UploadedFiles, EnterARunThatIsPlayedAlone) {
  const Page page({new_run(fresh_folder("idle"), "run").path().string()});
  const std::string heading = "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm\n";
  const nlohmann::json entered =
      page.post_files({{"sheet", "specimens.csv", heading + "a.csv,a,577fffe9fffdef,toughness,51.95,3.22,54\n"},
                       {"export", "a.csv", tutorial_export()},
                       {"choice", "", R"({"enter":["a"],"confirmed":["a"]})"}});
  EXPECT_EQ(entered.at("answers").at(0).at("answer"), "unanswered") << entered;
}

TEST(SeveralRuns, AreListedAndThoseThatCannotBeShownSayWhy) {
  const fs::path folder = fresh_folder("several_runs");
  const fs::path first = new_run(folder / "logs", "first").path(), second = new_run(folder / "logs", "second").path();
  fs::copy(first, folder / "copy", fs::copy_options::recursive);
  fs::create_directories(folder / "empty");
  const Page page({first.string(), (folder / "empty").string(), (folder / "copy").string(), second.string()});
  EXPECT_THAT(page.said(), HasSubstr("shows first, second"));
  const nlohmann::json runs = page.get("/api/runs").at("runs");
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(runs[0].at("state"), "stopped");
  EXPECT_EQ(runs[1].at("state"), "unreadable");
  EXPECT_EQ(runs[1].at("run"), "empty") << "an address can hold the name";
  EXPECT_THAT(runs[1].at("problem").get<std::string>(), HasSubstr("manifest.json"));
  EXPECT_THAT(runs[2].at("problem").get<std::string>(), HasSubstr("is called first, too"));
  EXPECT_EQ(runs[3].at("run"), "second");
  EXPECT_EQ(page.get("/runs/second/api/run").at("run"), "second");
  EXPECT_EQ(page.get("/api/run").at("run"), "first");
  EXPECT_THAT(page.get("/runs/..%2f..%2fetc/api/run").at("error").get<std::string>(), HasSubstr("there is no run"));
}

TEST(SeveralRuns, AreRefusedWhereNoneCanBeShownOrTooManyAreNamed) {
  const fs::path folder = fresh_folder("no_runs");
  const Outcome one = run_nacre({"dashboard", (folder / "a").string()});
  EXPECT_EQ(one.status, 2);
  EXPECT_THAT(one.err, HasSubstr("manifest.json"));
  const Outcome two = run_nacre({"dashboard", (folder / "a").string(), (folder / "b").string()});
  EXPECT_EQ(two.status, 2);
  EXPECT_THAT(two.err, HasSubstr("none of the runs can be shown"));
  std::vector<std::string> nine = {"dashboard"};
  for (int i = 0; i < 9; ++i) nine.push_back((folder / std::to_string(i)).string());
  EXPECT_THAT(run_nacre(nine).err, HasSubstr("9 runs, expected at most 8"));
  EXPECT_THAT(run_nacre({"dashboard", "a", "b", "--families", "c"}).err, HasSubstr("expected one run"));
}

}  // namespace
}  // namespace nacre
