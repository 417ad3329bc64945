#pragma once
// Expected growth of chi squared of a wrong model by a further test, with its constants refitted.

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "diagnosis/evidence.hpp"
#include "diagnosis/possible_tests.hpp"
#include "diagnosis/test_choice.hpp"

namespace nacre::diagnosis {

/// Predictions by fitted models of tests that are not made yet, and the separation of the models by them.
///
/// The constants of a model that is wrong are refitted once a test is made, and the discretisation error is shared by
/// all moduli: differences of bare predictions promise several times the separation that a test gives. Slopes of moduli
/// and coupons by the constants are computed; those of a fracture test are those of the same layout as it was measured,
/// or the mean of the measured ones.
class PredictedTests {
 public:
  /// Simulates each test at each of the models, which were fitted to the observations of the evidence; `replicates` of
  /// each are made. The observations must outlive this.
  PredictedTests(const Evidence& evidence, std::vector<FittedModel> models, const std::vector<PossibleTest>& tests,
                 int replicates);
  /// For a test and each pair of models, the feature that separates them best, and by how many standard errors. Their
  /// square is the growth of the wrong model's chi squared by the test, after its constants are refitted: the mean of
  /// both cases, since either may be the wrong one; where one is the other with effects added, which imitate any
  /// prediction of the other, the growth of that other. No errors: the test gives no information, or none beyond
  /// another replicate of a measured specimen.
  std::vector<Separation> separations(std::size_t test,
                                      const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const;

 private:
  /// A row of a test, conditioned on the measured rows.
  struct NewRow {
    int row = 0;               ///< in added_
    int against = -1;          ///< a row that it is compared relative to; -1: none
    Eigen::VectorXd whitened;  ///< its covariance with the measured rows
    double variance = 0.0;     ///< when the measured rows are known
  };
  /// A wrong model refitted to the predictions of the measured rows by a true one.
  struct WrongModelRefit {
    Eigen::VectorXd step;  ///< of its coordinates
    Eigen::VectorXd left;  ///< residuals of the rows, whitened
  };

  std::vector<int> add_group(Observation group, const std::vector<FeatureValues>& seen);
  void put_fracture(std::size_t model, int row, const FeatureValues& seen);
  void join();
  WrongModelRefit refit(const FittedModel& truth, const FittedModel& wrong) const;
  NewRow new_row(int row) const;
  /// Whether the same design was measured under conditions from which both models predict the same change: a further
  /// replicate, which separates the models no better than it did.
  bool is_replicate(const NewRow& row, std::size_t a, std::size_t b) const;
  /// Of chi squared of the wrong model with the row, its constants refitted.
  double growth(const NewRow& row, std::size_t truth, std::size_t wrong) const;

  const Observations& measured_;
  std::vector<FittedModel> models_;
  double same_errors_ = 0.0;                               ///< TestRules::same_errors
  Whitener whitener_;                                      ///< of the measured rows
  Observations added_, joined_;                            ///< the tests alone, and behind the measured rows
  std::vector<std::vector<int>> rows_of_;                  ///< of each test, in added_
  std::vector<FittedModel> predicted_;                     ///< the models over the rows of added_
  std::vector<Eigen::MatrixXd> columns_;                   ///< of each model: FittedModel::whitened_columns()
  std::vector<Eigen::LDLT<Eigen::MatrixXd>> information_;  ///< of each model's free coordinates
  std::vector<std::vector<WrongModelRefit>> refits_;       ///< by truth and wrong model
};

}  // namespace nacre::diagnosis
