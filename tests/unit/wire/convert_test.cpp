#include "wire/convert.hpp"

#include <functional>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "samples.hpp"
#include "wire/channels.hpp"
#include "wire/from_json.hpp"
#include "wire/schema.hpp"

namespace nacre::wire {
namespace {

template <class Domain>
void expect_round_trip(const Domain& value) {
  const Result<Domain> back = read<Domain>(write(value));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, value);
}

using Fields = nlohmann::ordered_json;

/// Whether a message is refused once its fields have been changed.
template <class Message>
bool is_refused_with(const Message& message, const std::function<void(Fields&)>& change) {
  const char* type = Message::Wire::getTypeName();
  Fields fields = to_json(type, write(message)).value();
  change(fields);
  return !read<Message>(from_json(type, fields).value());
}

TEST(Convert, EveryDomainValueComesBack) {
  expect_round_trip(samples::model());
  expect_round_trip(samples::request());
  expect_round_trip(samples::result());
  expect_round_trip(samples::fracture());
  expect_round_trip(samples::gamut());
  expect_round_trip(samples::proposal());
  expect_round_trip(samples::order());
  expect_round_trip(samples::measurement());
  expect_round_trip(samples::round());
  expect_round_trip(samples::family());
  expect_round_trip(samples::family_gamut());
  expect_round_trip(samples::diagnosis());
  expect_round_trip(samples::approval());
  expect_round_trip(samples::review());
  expect_round_trip(samples::withdrawal());
  expect_round_trip(samples::ack());
  expect_round_trip(samples::ask());
  expect_round_trip(samples::status());
  expect_round_trip(samples::diagnose());
}

TEST(Convert, PhysicallyImpossibleParametersAreRefused) {
  SimulateRequest request = samples::request();
  request.parameters.toughness.e_vw_pa = -1.0;
  const auto read_back = read<SimulateRequest>(write(request));
  ASSERT_FALSE(read_back);
  EXPECT_NE(read_back.error().message.find("e_vw"), std::string::npos) << read_back.error().message;
}

TEST(Convert, RequestsWithoutRequesterTestOrDesignAreRefused) {
  const auto refused = [](auto change) {
    SimulateRequest request = samples::request();
    change(request);
    return !read<SimulateRequest>(write(request));
  };
  EXPECT_TRUE(refused([](SimulateRequest& r) { r.request_id = "17"; }));
  EXPECT_TRUE(refused([](SimulateRequest& r) { r.modulus = r.toughness = false; }));
  EXPECT_TRUE(refused([](SimulateRequest& r) { r.designs.clear(); }));
  EXPECT_TRUE(refused([](SimulateRequest& r) { r.designs.assign(65, r.designs[0]); }));
  EXPECT_TRUE(refused([](SimulateRequest& r) { r.conditions.orientation_deg = 45.0; }));
  EXPECT_TRUE(refused([](SimulateRequest& r) { r.curve_points = 1501; }));
  EXPECT_FALSE(refused([](SimulateRequest& r) { r.designs.resize(1); }));
}

TEST(Convert, ARequestsIdEndsInTheHashOfAllThatIsAsked) {
  const SimulateRequest asked = with_content_id(samples::request());
  EXPECT_EQ(asked, with_content_id(samples::request())) << "no choice is left";
  const std::size_t end_of_place = asked.request_id.find('#');
  ASSERT_NE(end_of_place, std::string::npos);
  EXPECT_EQ(asked.request_id.substr(0, end_of_place), samples::request().request_id);
  EXPECT_EQ(asked.request_id.size() - end_of_place, 1U + 16U);
  EXPECT_EQ(requester_of(asked.request_id), "proposal_agent");
  expect_round_trip(asked);
  SimulateRequest rest = asked;
  rest.request_id = samples::request().request_id;
  EXPECT_EQ(rest, samples::request()) << "nothing else is changed";

  const auto hash_of = [](auto change) {
    SimulateRequest request = samples::request();
    change(request);
    const std::string id = with_content_id(request).request_id;
    return id.substr(id.find('#'));
  };
  const std::string hash = hash_of([](SimulateRequest&) {});
  EXPECT_EQ(hash, hash_of([](SimulateRequest& r) { r.request_id = "analyser/elsewhere"; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.modulus = false; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.crack = true; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.film = true; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.fidelity = tester::Fidelity::tiny; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.conditions.orientation_deg = 0.0; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.parameters.toughness.w_if_j_per_m3 *= 1.0 + 1e-15; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.parameters.extensions["droplet_mixing"] = {0.1}; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.curve_points = 99; }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { r.designs.pop_back(); }));
  EXPECT_NE(hash, hash_of([](SimulateRequest& r) { std::swap(r.designs[0], r.designs[1]); }))
      << "results are paired with designs by their places";
}

TEST(Convert, CracksAndFilmsAreAskedForWithToughnessOnly) {
  for (const bool crack : {false, true})
    for (const bool film : {false, true})
      for (const bool toughness : {false, true}) {
        SimulateRequest request = samples::request();
        request.toughness = toughness;
        request.crack = crack;
        request.film = film;
        const auto read_back = read<SimulateRequest>(write(request));
        ASSERT_EQ(read_back.has_value(), toughness || !(crack || film));
        if (read_back) {
          EXPECT_EQ(*read_back, request);
        }
      }
}

TEST(Convert, ImpossibleCracksAreRefused) {
  const auto refused = [](auto change) { return is_refused_with(samples::fracture(), change); };
  EXPECT_FALSE(refused([](Fields&) {}));
  EXPECT_TRUE(refused([](Fields& m) { m["request_id"] = "nobody"; }));
  EXPECT_TRUE(refused([](Fields& m) { m["path"][1] = 8; })) << "outside the grid";
  EXPECT_TRUE(refused([](Fields& m) { m["element"][0] = -1; }));
  EXPECT_TRUE(refused([](Fields& m) { m["length_m"] = 0.9 * m["straight_length_m"].get<double>(); }))
      << "shorter than straight";
  EXPECT_TRUE(refused([](Fields& m) { m["material_share"][0] = 0.5; })) << "shares above one";
  EXPECT_TRUE(refused([](Fields& m) { m["broken"] = 2; })) << "fewer than the order names";
  EXPECT_TRUE(refused([](Fields& m) { m["columns"] = 0; }));
}

TEST(Convert, AFilmIsAPlainFileNameAndNoPath) {
  for (const char* name : {"../../../etc/passwd", "/etc/passwd.film", "a/b.film", ".hidden.film", "film", "a b.film"}) {
    Fracture fracture = samples::fracture();
    fracture.film = name;
    EXPECT_FALSE(read<Fracture>(write(fracture))) << name;
  }
}

TEST(Convert, TheLongestFractureFitsOneMessage) {
  Fracture fracture = samples::fracture();
  fracture.crack.columns = fracture.crack.rows = 200;
  fracture.crack.order.assign(20'000, {39'999, 0.25});
  fracture.broken = 20'000;
  fracture.crack.path->elements.assign(20'000, 39'999);
  const std::string payload = write(fracture);
  EXPECT_LE(payload.size(), kMaximumBlankPayload);
  const auto read_back = read<Fracture>(payload);
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(read_back->broken, 20'000);
  EXPECT_EQ(read_back->crack.order.size(), kMaximumBreaks);
}

TEST(Convert, ValidSpecimensCarryAResult) {
  Measurement m = samples::measurement();
  m.record.toughness_pa.reset();
  m.record.curve = {};
  EXPECT_FALSE(read<Measurement>(write(m)));
  m.record.valid = false;  // a failed specimen has none
  EXPECT_TRUE(read<Measurement>(write(m)));
}

TEST(Convert, AnAmendmentHasItsAuthorAndReason) {
  Measurement measured = samples::measurement();
  measured.revision = 1;
  measured.by = "Ada";
  measured.why = " ";
  const auto refused = read<Measurement>(write(measured));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("why: is empty, expected a text: revision 1 amends specimen"),
            std::string::npos)
      << refused.error().message;
  measured.why = "decimal point";
  EXPECT_TRUE(read<Measurement>(write(measured)));
  measured.by.clear();
  EXPECT_FALSE(read<Measurement>(write(measured)));
  measured.by = "Ada";
  measured.revision = -1;
  EXPECT_FALSE(read<Measurement>(write(measured)));
}

TEST(Convert, AWithdrawalHasItsAuthorAndReason) {
  Withdrawal said = samples::withdrawal();
  said.why.clear();
  const auto refused = read<Withdrawal>(write(said));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("expected why r1/mix:0.65/toughness is withdrawn"), std::string::npos)
      << refused.error().message;
  said.withdrawn = false;
  EXPECT_TRUE(read<Withdrawal>(write(said))) << "giving an order again needs no reason";
  said.by.clear();
  EXPECT_FALSE(read<Withdrawal>(write(said)));
  said = samples::withdrawal();
  said.revision = 0;
  EXPECT_FALSE(read<Withdrawal>(write(said)));
}

TEST(Convert, ANameFitsOnALabel) {
  for (const std::string& name : {std::string(), std::string(201, 'x'), std::string("a\nb"), std::string("a\x7f")}) {
    Measurement m = samples::measurement();
    m.record.specimen = name;
    EXPECT_FALSE(read<Measurement>(write(m))) << name;
  }
}

TEST(Convert, AValueOfAnotherUnitIsNoValidSpecimen) {
  Measurement m = samples::measurement();
  const auto fault = [&] {
    const auto back = read<Measurement>(write(m));
    return back ? std::string() : back.error().message;
  };
  m.record.toughness_pa = 1.1;  // MJ/m3
  EXPECT_NE(fault().find("toughness_pa 1.1 Pa"), std::string::npos) << fault();
  EXPECT_NE(fault().find("is the unit Pa?"), std::string::npos) << fault();
  m.record.toughness_pa.reset();
  m.record.curve = {{0.0, 0.1, 0.2, 0.3, 0.4}, {0.0, 20.0, 20.0, 20.0, 0.0}};  // MPa
  EXPECT_NE(fault().find("toughness_pa"), std::string::npos) << fault();
  m.record.test = tester::TestKind::modulus;
  m.record.curve = {};
  for (const double modulus_pa : {0.0, 0.4, 9999.0}) {
    m.record.modulus_pa = modulus_pa;
    EXPECT_NE(fault().find("modulus_pa"), std::string::npos) << modulus_pa;
  }
  m.record.valid = false;
  EXPECT_EQ(fault(), "") << "kept, though never used";
  m.record.valid = true;
  m.record.modulus_pa = 1e4;
  EXPECT_EQ(fault(), "");
  m.record.modulus_pa.reset();
  m.record.curve = {{0.0, 0.0005, 0.001, 0.002, 0.003}, {0.0, 5e2, 1e3, 2e3, 3e3}};
  EXPECT_EQ(fault(), "") << "the area under the curve of a modulus test is no toughness";
}

TEST(Convert, ErrorsOfTheOddestValidSpecimensCanBeTold) {
  AdoptedModel model = samples::model();
  model.before.modulus_max = 1e13 / 1e4;
  model.before.toughness_max = 1e13 / 10.0;
  expect_round_trip(model);
  RoundSummary round = samples::round();
  round.measured_hypervolume_staircase = 1e4 * 1e7;  // GPa MPa of 1e13 Pa each
  expect_round_trip(round);
}

TEST(Convert, ADiagnosisHoldsNumbersThatAreOnesAndKnownStates) {
  const auto refused = [](auto change) { return is_refused_with(samples::diagnosis(), change); };
  static constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused([](Fields&) {}));
  EXPECT_TRUE(refused([](Fields& m) { m["effects"][0]["name"] = ""; }));
  EXPECT_TRUE(refused([](Fields& m) { m["effects"][0]["parameter"] = kNoNumber; }));
  EXPECT_TRUE(refused([](Fields& m) { m["effects"][0]["interval_high"] = 1.0 / 0.0; }));
  EXPECT_TRUE(refused([](Fields& m) { m["candidates"][0]["name"] = ""; }));
  EXPECT_TRUE(refused([](Fields& m) { m["candidates"][0]["status"] = "guilty"; }));
  EXPECT_TRUE(refused([](Fields& m) { m["candidates"][0]["statistic"] = kNoNumber; }));
  EXPECT_TRUE(refused([](Fields& m) { m["candidates"][0]["p_family_wise"] = 1.1; }));
  EXPECT_TRUE(refused([](Fields& m) { m["candidates"][0]["absorption"] = kNoNumber; }));
  EXPECT_TRUE(refused([](Fields& m) {
    m["has_gain"] = true;
    m["relative_reduction"] = kNoNumber;
  }));
  EXPECT_TRUE(refused([](Fields& m) { m["next_experiments"][0]["replicates"] = 0; }));
}

TEST(Convert, CodesOutsideTheEnumerationsAreRefused) {
  const auto refused = [](const char* field, const Fields& value) {
    return is_refused_with(samples::measurement(), [&](Fields& m) { m[field] = value; });
  };
  EXPECT_FALSE(refused("test", 1));
  EXPECT_TRUE(refused("test", 3));
  EXPECT_TRUE(refused("fidelity", -1));
  EXPECT_TRUE(refused("design", "577fffe9fffdeZ"));
}

TEST(Convert, ResponsesAreCutBelowADatagramAndJoinedInAnyOrder) {
  std::vector<SimulatedDesign> results(64);
  for (std::size_t i = 0; i < results.size(); ++i) {
    results[i].design = pattern::Pattern(i);
    results[i].modulus_pa = 1e9 + static_cast<double>(i);
    results[i].curve = {std::vector<double>(500, 0.25), std::vector<double>(500, static_cast<double>(i))};
  }
  std::vector<SimulateResult> parts = simulate_response("analyser/1", results);
  ASSERT_GT(parts.size(), 3u);
  ResponseCollector collector;
  std::optional<std::vector<SimulatedDesign>> whole;
  for (std::size_t i = parts.size(); i-- > 0;) {
    EXPECT_LE(write(parts[i]).size(), kMaximumBlankPayload);
    EXPECT_FALSE(whole);
    whole = collector.add(*read<SimulateResult>(write(parts[i])));
    if (i == 2) {
      EXPECT_FALSE(collector.add(parts[2]));  // a repetition completes nothing
    }
  }
  ASSERT_TRUE(whole);
  EXPECT_EQ(*whole, results);
}

TEST(Convert, GamutsAreCutIntoChunksAndJoined) {
  std::vector<explore::Evaluated> samples;
  for (std::uint64_t i = 0; i < 2500; ++i) samples.push_back({pattern::Pattern(i), {1e9, static_cast<double>(i)}});
  const std::vector<GamutChunk> chunks = gamut_chunks(2, tester::Fidelity::tiny, samples);
  ASSERT_EQ(chunks.size(), 3u);
  GamutCollector collector;
  for (const int place : {2, 0, 2}) {
    collector.add(chunks[place]);
    EXPECT_EQ(collector.whole(2), nullptr);
  }
  EXPECT_LE(write(chunks[0]).size(), kMaximumBlankPayload);
  collector.add(chunks[1]);
  ASSERT_NE(collector.whole(2), nullptr);
  EXPECT_EQ(*collector.whole(2), samples);
  EXPECT_EQ(gamut_chunks(2, tester::Fidelity::tiny, {}).size(), 1u);
}

std::vector<explore::Evaluated> gamut_until(std::uint64_t count) {
  std::vector<explore::Evaluated> samples;
  for (std::uint64_t i = 0; i < count; ++i) samples.push_back({pattern::Pattern(i), {1e9, static_cast<double>(i)}});
  return samples;
}

TEST(Convert, AGamutIsSentAsWhatItAddsToTheLast) {
  const auto first = gamut_until(10);
  auto second = gamut_until(12);
  second[3].performance.toughness_pa = 0.5;  // the mean of further realisations
  const std::vector<GamutChunk> chunks = gamut_chunks(4, tester::Fidelity::tiny, second, 3, first);
  ASSERT_EQ(chunks.size(), 1u);
  EXPECT_EQ(chunks[0].base, 3);
  EXPECT_EQ(chunks[0].total, 12);
  EXPECT_EQ(chunks[0].samples, (std::vector{second[3], second[10], second[11]}));
}

TEST(Convert, AGamutThatIsNoOtherWithChangesIsSentWhole) {
  const auto first = gamut_until(10), shorter = gamut_until(5);
  auto all_else = first, turned = first;
  for (explore::Evaluated& sample : all_else) sample.performance.modulus_pa = 2e9;
  std::swap(turned.front(), turned.back());
  for (const auto& now : {shorter, all_else, turned}) {
    const std::vector<GamutChunk> chunks = gamut_chunks(4, tester::Fidelity::tiny, now, 3, first);
    EXPECT_EQ(chunks, gamut_chunks(4, tester::Fidelity::tiny, now));
    EXPECT_EQ(chunks[0].base, -1);
  }
}

TEST(Convert, AGamutIsWholeOnceItsBasesAreWhateverComesFirst) {
  std::vector<GamutChunk> chunks;
  for (int round = 0; round < 4; ++round)
    for (GamutChunk& chunk : gamut_chunks(round, tester::Fidelity::tiny, gamut_until(5 + round), round - 1,
                                          gamut_until(round == 0 ? 0 : 4 + round)))
      chunks.push_back(std::move(chunk));
  ASSERT_EQ(chunks.size(), 4u);
  GamutCollector collector;
  for (const int place : {3, 1, 3, 2}) {
    collector.add(chunks[place]);
    EXPECT_EQ(collector.whole(3), nullptr) << "round 0 has not come";
  }
  collector.add(chunks[0]);
  for (int round = 3; round >= 0; --round) {
    ASSERT_NE(collector.whole(round), nullptr);
    EXPECT_EQ(*collector.whole(round), gamut_until(5 + round));
  }
  collector.forget_before(3);
  EXPECT_EQ(collector.whole(2), nullptr);
  EXPECT_NE(collector.whole(3), nullptr) << "the next round may add to it";
}

TEST(Convert, AGamutHasNoBaseOfItsOwnRoundOrALaterOne) {
  GamutChunk chunk = gamut_chunks(4, tester::Fidelity::tiny, gamut_until(2)).front();
  for (const int base : {4, 5, -2}) {
    chunk.base = base;
    const auto read_back = read<GamutChunk>(write(chunk));
    ASSERT_FALSE(read_back);
    EXPECT_NE(read_back.error().message.find("base"), std::string::npos) << read_back.error().message;
  }
}

}  // namespace
}  // namespace nacre::wire
