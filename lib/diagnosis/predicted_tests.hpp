#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "diagnosis/possible_tests.hpp"
#include "diagnosis/test_choice.hpp"
#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// What fitted models foretell of tests that nobody has made, and how far apart those would put them.
///
/// The constants of a model that is wrong are fitted again once a test is made, and what finer elements change is
/// shared by all moduli: differences of bare predictions promise several times what a test gives. Slopes of moduli and
/// coupons by the constants are computed; those of a fracture test are those of the same layout as it was measured, or
/// the mean of what was measured.
class PredictedTests {
 public:
  /// Simulates each test at each of the models, which were fitted to the observations of the evidence; `replicates` of
  /// each are made. The observations must outlive this.
  PredictedTests(const Evidence& evidence, std::vector<FittedModel> models, const std::vector<PossibleTest>& tests,
                 int replicates);
  /// For a test and each pair of models, the feature that tells them apart best, and by how many standard errors. Their
  /// square is by how much the chi squared of the wrong model grows with the test, after its constants are fitted
  /// again: the mean of both cases, since either may be the wrong one; where one is the other with effects added, which
  /// imitate anything that the other foretells, the growth of that other. No errors: the test says nothing, or nothing
  /// but what another replicate of a measured specimen would.
  std::vector<Separation> separations(std::size_t test,
                                      const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const;

 private:
  /// A row of a test seen from what was measured.
  struct NewRow {
    int row = 0;               ///< in added_
    int against = -1;          ///< a row that it is compared relative to; -1: none
    Eigen::VectorXd whitened;  ///< its covariance with the measured rows
    double variance = 0.0;     ///< when the measured rows are known
  };
  /// A wrong model fitted again to what a true one predicts of the measured rows.
  struct Refit {
    Eigen::VectorXd step;  ///< of its coordinates
    Eigen::VectorXd left;  ///< of the rows, whitened
  };

  std::vector<int> add_group(Observation group, const std::vector<FeatureValues>& seen);
  void put_fracture(std::size_t model, int row, const FeatureValues& seen);
  void join();
  Refit refit(const FittedModel& truth, const FittedModel& wrong) const;
  NewRow new_row(int row) const;
  /// Whether the same design is measured under conditions from which both models foretell the same change: more of what
  /// is there, which tells the models apart no better than it did.
  bool is_replicate(const NewRow& row, std::size_t a, std::size_t b) const;
  /// Of chi squared of the wrong model with the row, its constants fitted again.
  double growth(const NewRow& row, std::size_t truth, std::size_t wrong) const;

  const Observations& measured_;
  std::vector<FittedModel> models_;
  Whitener whitener_;                                      ///< of the measured rows
  Observations added_, joined_;                            ///< the tests alone, and behind what was measured
  std::vector<std::vector<int>> rows_of_;                  ///< of each test, in added_
  std::vector<FittedModel> predicted_;                     ///< the models over the rows of added_
  std::vector<Eigen::MatrixXd> columns_;                   ///< of each model: Fit::whitened_columns()
  std::vector<Eigen::LDLT<Eigen::MatrixXd>> information_;  ///< of each model's free coordinates
  std::vector<std::vector<Refit>> refits_;                 ///< by truth and wrong model
};

}  // namespace nacre::diagnosis
