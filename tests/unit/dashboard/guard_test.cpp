#include "dashboard/guard.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "dashboard/upload.hpp"

namespace nacre::dashboard {
namespace {

const AccessRules kOpen{.hosts = host_names("127.0.0.1", 8765), .token = "", .cookie_name = "nacre_8765"};
const AccessRules kClosed{
    .hosts = host_names("0.0.0.0", 8765), .token = "0123456789abcdef", .cookie_name = "nacre_8765"};

Request reading(const std::string& host = "127.0.0.1:8765") {
  return {.method = "GET", .path = "/api/run", .query = {}, .headers = {{"host", host}}, .body = ""};
}

Request writing() {
  return {.method = "POST",
          .path = "/api/review",
          .query = {},
          .headers = {{"host", "localhost:8765"},
                      {"x-nacre", "1"},
                      {"content-type", "application/json"},
                      {"content-length", "2"},
                      {"origin", "http://localhost:8765"},
                      {"sec-fetch-site", "same-origin"}},
          .body = "{}"};
}

int status(const AccessRules& rules, const Request& request) {
  const auto refusal = refused(rules, request);
  return refusal ? refusal->status : 200;
}

Request with(Request request, const std::string& header, const std::string& value) {
  value.empty() ? (void)request.headers.erase(header) : (void)(request.headers[header] = value);
  return request;
}

TEST(Guard, LetsThisMachineIn) {
  for (const char* host : {"127.0.0.1:8765", "localhost:8765", "[::1]:8765"})
    EXPECT_EQ(status(kOpen, reading(host)), 200) << host;
  EXPECT_EQ(status(kOpen, writing()), 200);
}

TEST(Guard, NamesHaveNoCase) {
  const AccessRules rules{.hosts = host_names("LabPC", 8765), .token = "", .cookie_name = "nacre_8765"};
  for (const char* host : {"labpc:8765", "LabPC:8765", "LOCALHOST:8765"}) EXPECT_EQ(status(rules, reading(host)), 200);
}

TEST(Guard, TheLinkOpensThePageFromElsewhereToo) {
  EXPECT_EQ(page_link("127.0.0.1", 8765, ""), "http://127.0.0.1:8765/");
  EXPECT_EQ(page_link("::1", 8765, ""), "http://[::1]:8765/");
  EXPECT_EQ(page_link("labpc", 80, "0123"), "http://labpc:80/?token=0123");
  std::array<char, 256> own{};
  ASSERT_EQ(::gethostname(own.data(), own.size() - 1), 0);
  for (const char* everywhere : {"0.0.0.0", "::"})
    EXPECT_EQ(page_link(everywhere, 8765, "0123"), std::string("http://") + own.data() + ":8765/?token=0123");
}

TEST(Guard, RefusesNamesThatAreNotItsOwn) {
  for (const char* host :
       {"evil.example:8765", "localhost.evil.example", "", "127.0.0.1.evil.example:8765", "10.0.0.7:8765", ":8765"})
    EXPECT_EQ(status(kOpen, reading(host)), 421) << host;
  EXPECT_EQ(status(kClosed, with(reading("evil.example:8765"), "authorization", "Bearer 0123456789abcdef")), 421);
}

// A tunnel has a port of its own at home: no foreign page can be called localhost.
TEST(Guard, LetsATunnelInUnderThisMachinesNamesAndAProxyUnderTheOneThatWasAllowed) {
  for (const char* host : {"localhost:9000", "localhost", "localhost.", "127.0.0.1:80", "[::1]"})
    EXPECT_EQ(status(kOpen, reading(host)), 200) << host;
  AccessRules rules = kOpen;
  rules.hosts.insert(rules.hosts.end(), {"lab.example", "other.example:444"});
  for (const char* host : {"lab.example", "Lab.Example:8443", "other.example:444"})
    EXPECT_EQ(status(rules, reading(host)), 200) << host;
  for (const char* host : {"other.example", "other.example:445", "evil.example"})
    EXPECT_EQ(status(rules, reading(host)), 421) << host;
}

TEST(Guard, AsksForTheToken) {
  EXPECT_EQ(status(kClosed, reading()), 401);
  EXPECT_EQ(status(kClosed, reading("192.168.1.7:8765")), 401);
  EXPECT_EQ(status(kClosed, with(reading(), "authorization", "Bearer 0123456789abcdee")), 401);
  EXPECT_EQ(status(kClosed, with(reading(), "authorization", "Bearer 0123456789abcdef")), 200);
  EXPECT_EQ(status(kClosed, with(reading(), "cookie", "a=b; nacre_8765=0123456789abcdef; c=d")), 200);
  EXPECT_EQ(status(kClosed, with(reading(), "cookie", "nacre_8765=0123456789abcde")), 401);
  EXPECT_EQ(status(kClosed, with(reading(), "cookie", "xnacre_8765=0123456789abcdef")), 401);
  EXPECT_EQ(status(kClosed, writing()), 401);
}

TEST(Guard, TurnsTheLinkWithTheTokenIntoACookie) {
  Request request = reading();
  request.path = "/";
  request.query["token"] = kClosed.token;
  const auto answer = refused(kClosed, request);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 303);
  EXPECT_EQ(answer->headers.at(1).second, "nacre_8765=0123456789abcdef; HttpOnly; SameSite=Strict; Path=/");
  request.query["token"] = "0123456789abcdee";
  EXPECT_EQ(status(kClosed, request), 401);
}

TEST(Guard, RefusesEntriesThatAnotherPageCouldSend) {
  EXPECT_EQ(status(kOpen, with(writing(), "x-nacre", "")), 403);
  EXPECT_EQ(status(kOpen, with(writing(), "origin", "http://evil.example")), 403);
  EXPECT_EQ(status(kOpen, with(writing(), "origin", "null")), 403);
  EXPECT_EQ(status(kOpen, with(writing(), "sec-fetch-site", "cross-site")), 403);
  EXPECT_EQ(status(kOpen, with(writing(), "content-type", "text/plain")), 415);
  EXPECT_EQ(status(kOpen, with(writing(), "content-encoding", "gzip")), 415);
  EXPECT_EQ(status(kOpen, with(writing(), "content-length", "")), 411);
  EXPECT_EQ(status(kOpen, with(writing(), "transfer-encoding", "chunked")), 411);
}

TEST(Guard, LetsFilesInWhereTheyBelong) {
  Request files = with(writing(), "content-type", "multipart/form-data; boundary=x");
  EXPECT_EQ(status(kOpen, files), 415);
  for (const char* path : {"/api/import", "/runs/demo/api/import"}) {
    files.path = path;
    EXPECT_EQ(status(kOpen, files), 200) << path;
    EXPECT_EQ(status(kOpen, with(files, "x-nacre", "")), 403);
    EXPECT_EQ(status(kOpen, with(files, "content-type", "application/json")), 415);
  }
}

TEST(Guard, RefusesBodiesThatAreTooLargeByTheirAnnouncedLength) {
  EXPECT_EQ(status(kOpen, with(writing(), "content-length", std::to_string(kMostBodyBytes))), 200);
  for (const std::string length : {std::to_string(kMostBodyBytes + 1), std::string("99999999999999999999"),
                                   std::string("-1"), std::string("1x")})
    EXPECT_EQ(status(kOpen, with(writing(), "content-length", length)), 413) << length;
  Request files = with(writing(), "content-type", "multipart/form-data; boundary=x");
  files.path = "/api/import";
  EXPECT_EQ(status(kOpen, with(files, "content-length", std::to_string(kMostUploadBytes))), 200);
  EXPECT_EQ(status(kOpen, with(files, "content-length", std::to_string(kMostUploadBytes + 1))), 413);
}

TEST(Guard, RefusesOtherMethodsAndLongPaths) {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", ""}) {
    Request request = reading();
    request.method = method;
    EXPECT_EQ(status(kOpen, request), 405) << method;
  }
  Request request = reading();
  request.path = std::string(513, 'a');
  EXPECT_EQ(status(kOpen, request), 414);
}

TEST(Guard, DrawsATokenOf128Bits) {
  EXPECT_EQ(random_token().size(), 32u);
  EXPECT_NE(random_token(), random_token());
}

}  // namespace
}  // namespace nacre::dashboard
