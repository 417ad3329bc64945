#pragma once
// Messages in, the record of a run out: decoded once, in the order of their arrival.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "run/message_place.hpp"
#include "run/run_record.hpp"
#include "wire/convert.hpp"

namespace nacre::run {

class Recording {
 public:
  /// `id`: of the message, by which the chunks of gamuts are found again. What does not decode changes nothing.
  void take(std::int64_t id, std::string_view channel, const std::string& payload);
  /// Without gamuts.
  RunRecord record() const;
  /// Messages that hold the gamut of a round, those of its bases first: of one pattern the later sample counts.
  std::vector<std::int64_t> gamut_messages(int round) const;
  /// Messages that hold the variants of a family by number, by chunk.
  std::vector<std::int64_t> variant_messages(int family) const;

 private:
  /// What has come of a gamut.
  struct Chunks {
    int base = -1;
    int count = 0;                    ///< samples
    int total = 0;                    ///< of the whole gamut
    int chunks = 1;                   ///< expected
    std::map<int, std::int64_t> ids;  ///< by chunk
  };

  void take(const wire::RoundSummary& summary);
  void take(const wire::Measurement& measured);
  void take(const wire::SimulateResult& response);
  void take(const wire::Fracture& fracture);
  void take(const wire::CalibratedFamily& family);
  void take_review(const std::string& payload);
  void take(std::int64_t id, const wire::GamutChunk& gamut);
  void describe_gamut(int number, RoundRecord& round) const;

  std::map<int, RoundRecord> rounds_;
  std::map<int, FamilyRecord> families_;
  std::map<std::string, MeasuredSpecimen> specimens_;
  std::map<std::string, wire::Review> reviews_;  ///< that count, by specimen
  std::map<int, Chunks> gamuts_, variants_;      ///< by round, by family
  ClosedRounds closed_;
  std::optional<wire::Reveal> revealed_;
};

}  // namespace nacre::run
