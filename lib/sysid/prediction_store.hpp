#pragma once
// A file of simulated predictions: "nacre predictions 1\n", then records (key length, points, E, T; key; strains;
// stresses).

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "sysid/prediction.hpp"

namespace nacre::sysid {

/// Predictions of the testers by key, in memory and, when a file is given, on disk: no simulation is done twice, not
/// even after an interruption. The file is only ever appended to; a record that was cut off by a crash is dropped when
/// the file is read. Curves are kept as 128 points in single precision, and a prediction is the same whether it comes
/// from the file or was just put in.
class PredictionStore {
 public:
  PredictionStore() = default;
  /// Throws InputError when the file cannot be read or written, or is no store.
  explicit PredictionStore(const std::filesystem::path& file);
  /// Nothing when the key is unknown; a prediction without values when the simulation failed.
  const Prediction* find(const std::string& key) const;
  /// Throws InputError when the file cannot be written.
  const Prediction& put(const std::string& key, const Prediction& prediction);
  std::size_t size() const { return known_.size(); }

 private:
  /// False when not even the first line is whole.
  bool read(const std::filesystem::path& file);

  std::map<std::string, Prediction> known_;
  std::optional<std::ofstream> file_;
};

}  // namespace nacre::sysid
