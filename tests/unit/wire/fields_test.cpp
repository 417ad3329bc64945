// Every table of fields against its .lcm file: names, order and types, and the bytes of LCM's own codec.

#include "base/fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"
#include "wire/channels.hpp"
#include "wire/lcm_types.hpp"

namespace nacre::wire {
namespace {

template <class Names>
struct Columns {
  Names& names;
  void operator()(std::string_view name, auto&&...) { names.add(std::string(name) + "[]"); }
  void single(std::string_view name, auto&&...) { names.add(std::string(name) + "[]"); }
};

/// "estimates[].low90" of every field, by the table.
class FieldNames {
 public:
  std::vector<std::string> names;

  template <class T>
  void operator()(std::string_view name, const T&, const auto&...) {
    if constexpr (IsList<T>::value) {
      inside<typename T::value_type>(std::string(name) + "[]");
    } else {
      inside<T>(std::string(name));
    }
  }
  void count(std::string_view name, auto&&...) { add(name); }
  void first(std::string_view name, auto&&...) { add(name); }
  void single(std::string_view name, auto&&...) { add(std::string(name) + "[]"); }
  template <class Element>
  void columns(const std::vector<Element>&, const auto& table) {
    Columns<FieldNames> columns{*this};
    Element element{};
    table(columns, element);
  }
  void maybe(std::string_view has, std::string_view name, auto&&...) { add(has), add(name); }
  void or_zero(std::string_view name, auto&&...) { add(name); }
  template <class Part>
  void part(std::string_view has, std::string_view, const std::optional<Part>&) {
    add(has);
    inside<Part>("");
  }
  void failure(std::string_view ok, std::string_view name, auto&&...) { add(ok), add(name); }
  void bits(std::string_view name, auto&&...) { add(name); }

  void add(std::string_view name) { names.push_back(prefix_ + std::string(name)); }

 private:
  template <class T>
  void inside(const std::string& name) {
    if constexpr (HasFields<T>) {
      const std::string outside = prefix_;
      if (!name.empty()) prefix_ += name + ".";
      const T value{};
      walk_fields(*this, value);
      prefix_ = outside;
    } else {
      add(name);
    }
  }
  std::string prefix_;
};

void add_names(const Struct& type, const std::string& prefix, std::vector<std::string>& names) {
  for (const Member& member : type.members) {
    const std::string name = prefix + member.name + (member.is_array() ? "[]" : "");
    if (member.structure == nullptr) {
      names.push_back(name);
    } else if (member.name != "header") {
      add_names(*member.structure, name + ".", names);
    }
  }
}

template <class Message>
void expect_table_of_lcm_file(const Message& sample) {
  using Wire = typename Message::Wire;
  SCOPED_TRACE(Wire::getTypeName());
  std::vector<std::string> of_file;
  add_names(message_types().at(Wire::getTypeName()), "", of_file);
  FieldNames of_table;
  const Message nothing{};
  walk_fields(of_table, nothing);
  EXPECT_EQ(of_table.names, of_file);

  const std::string payload = write(sample);
  Wire decoded;
  ASSERT_EQ(decoded.decode(payload.data(), 0, static_cast<int>(payload.size())), static_cast<int>(payload.size()));
  std::string encoded(payload.size(), '\0');
  ASSERT_EQ(decoded.getEncodedSize(), static_cast<int>(payload.size()));
  decoded.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
  EXPECT_EQ(encoded, payload);
}

TEST(Fields, AreThoseOfTheLcmFileInItsOrder) {
  expect_table_of_lcm_file(samples::run());
  expect_table_of_lcm_file(samples::model());
  expect_table_of_lcm_file(samples::request());
  expect_table_of_lcm_file(samples::result());
  expect_table_of_lcm_file(samples::fracture());
  expect_table_of_lcm_file(samples::gamut());
  expect_table_of_lcm_file(samples::proposal());
  expect_table_of_lcm_file(samples::approval());
  expect_table_of_lcm_file(samples::order());
  expect_table_of_lcm_file(samples::measurement());
  expect_table_of_lcm_file(samples::review());
  expect_table_of_lcm_file(samples::reveal());
  expect_table_of_lcm_file(samples::diagnose());
  expect_table_of_lcm_file(samples::diagnosis());
  expect_table_of_lcm_file(samples::round());
  expect_table_of_lcm_file(samples::family());
  expect_table_of_lcm_file(samples::family_gamut());
  expect_table_of_lcm_file(samples::ack());
  expect_table_of_lcm_file(samples::ask());
  expect_table_of_lcm_file(samples::status());
}

TEST(Fields, AnErrorNamesTheFieldTheValueAndWhatIsAllowed) {
  const auto error_of = [](const auto& message) {
    using Message = std::decay_t<decltype(message)>;
    const auto read_back = read<Message>(write(message));
    return read_back ? std::string() : read_back.error().message;
  };
  Proposal proposal = samples::proposal();
  proposal.designs[0].modulus_pa = -1.0;
  EXPECT_EQ(error_of(proposal), "proposal_t: designs[0].modulus_pa: -1 is outside [0, 10000000000000]");
  SimulateRequest request = samples::request();
  request.conditions.orientation_deg = 45.0;
  EXPECT_EQ(error_of(request), "simulate_request_t: conditions.orientation_deg: 45 degrees, expected 0 or 90");
  request = samples::request();
  request.request_id = "17";
  EXPECT_EQ(error_of(request), "simulate_request_t: request_id: \"17\" does not begin with a node's name and '/'");
  Diagnosis diagnosis = samples::diagnosis();
  diagnosis.candidates[0].status = "guilty";
  EXPECT_EQ(error_of(diagnosis),
            "diagnosis_t: candidates[0].status: \"guilty\", expected in_set, excluded, invisible, not_simulated or "
            "not_applicable");
  Fracture fracture = samples::fracture();
  fracture.crack.path->material = {0.5, 0.5, 0.25};
  EXPECT_EQ(error_of(fracture), "fracture_t: material_share: the sum is 1.25, expected 1");
  GamutChunk chunk = samples::gamut();
  chunk.samples[1].performance.toughness_pa = 1e14;
  EXPECT_THAT(error_of(chunk), testing::HasSubstr("gamut_t: toughness_pa[1]: "));
  chunk = samples::gamut();
  chunk.chunk = 1;
  EXPECT_EQ(error_of(chunk), "gamut_t: chunk: 1 is no index into 1");
}

}  // namespace
}  // namespace nacre::wire
