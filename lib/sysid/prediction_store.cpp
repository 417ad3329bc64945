#include "sysid/prediction_store.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::sysid {
namespace {

constexpr std::string_view kMagic = "nacre predictions 1\n";
constexpr int kCurvePoints = 128;

/// What stands before the key and the curve of a record.
struct Head {
  std::uint32_t key_length = 0, points = 0;
  double modulus_pa = 0.0, toughness_pa = 0.0;  ///< not a number: none
};
static_assert(sizeof(Head) == 24);

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

Prediction stored_form(const Prediction& prediction) {
  Prediction result = prediction;
  if (result.curve.size() > kCurvePoints) result.curve = tester::resampled(result.curve, kCurvePoints);
  for (auto* values : {&result.curve.strain, &result.curve.stress_pa}) {
    for (double& value : *values) value = static_cast<double>(static_cast<float>(value));
  }
  return result;
}

void append_floats(std::string& bytes, const std::vector<double>& values) {
  for (const double value : values) {
    const float single = static_cast<float>(value);
    bytes.append(reinterpret_cast<const char*>(&single), sizeof single);
  }
}

std::vector<double> floats_at(const char* bytes, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    float single = 0.0F;
    std::memcpy(&single, bytes + i * sizeof single, sizeof single);
    values[i] = static_cast<double>(single);
  }
  return values;
}

}  // namespace

PredictionStore::PredictionStore(const std::filesystem::path& file) {
  const bool exists = std::filesystem::exists(file);
  const bool is_store = exists && read(file);
  if (!exists && file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  file_.emplace(file, std::ios::binary | std::ios::app);
  if (!is_store) file_->write(kMagic.data(), static_cast<std::streamsize>(kMagic.size())).flush();
  if (!*file_)
    throw InputError::format("{}: the store of predictions cannot be written; is the folder writable?", file.string());
}

bool PredictionStore::read(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  if (kMagic.starts_with(bytes) && bytes != kMagic) {  // its first line was cut off by a crash
    std::filesystem::resize_file(file, 0);
    return false;
  }
  if (!bytes.starts_with(kMagic))
    throw InputError::format(
        "{}: is no store of predictions, expected \"nacre predictions 1\" in its first line; name another file",
        file.string());
  std::size_t at = kMagic.size();
  while (at + sizeof(Head) <= bytes.size()) {
    Head head;
    std::memcpy(&head, bytes.data() + at, sizeof head);
    const std::size_t curve_at = at + sizeof head + head.key_length;
    const std::size_t end = curve_at + 2 * sizeof(float) * head.points;
    if (end > bytes.size()) break;
    Prediction prediction;
    if (!std::isnan(head.modulus_pa)) prediction.modulus_pa = head.modulus_pa;
    if (!std::isnan(head.toughness_pa)) prediction.toughness_pa = head.toughness_pa;
    prediction.curve.strain = floats_at(bytes.data() + curve_at, head.points);
    prediction.curve.stress_pa = floats_at(bytes.data() + curve_at + sizeof(float) * head.points, head.points);
    known_[bytes.substr(at + sizeof head, head.key_length)] = std::move(prediction);
    at = end;
  }
  if (at < bytes.size()) std::filesystem::resize_file(file, at);
  return true;
}

const Prediction* PredictionStore::find(const std::string& key) const {
  const auto found = known_.find(key);
  return found == known_.end() ? nullptr : &found->second;
}

const Prediction& PredictionStore::put(const std::string& key, const Prediction& prediction) {
  const Prediction& kept = known_[key] = stored_form(prediction);
  if (file_) {
    const Head head{static_cast<std::uint32_t>(key.size()), static_cast<std::uint32_t>(kept.curve.size()),
                    kept.modulus_pa.value_or(kAbsent), kept.toughness_pa.value_or(kAbsent)};
    std::string bytes(reinterpret_cast<const char*>(&head), sizeof head);
    bytes += key;
    append_floats(bytes, kept.curve.strain);
    append_floats(bytes, kept.curve.stress_pa);
    if (!file_->write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
      throw InputError("the store of predictions cannot be written; is the disk full?");
  }
  return kept;
}

}  // namespace nacre::sysid
