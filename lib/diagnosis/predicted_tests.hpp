#pragma once
// Expected growth of chi squared of a wrong model by a further test, with its constants refitted.

#include <Eigen/Dense>
#include <map>
#include <utility>
#include <vector>

#include "diagnosis/evidence.hpp"
#include "diagnosis/explanations.hpp"
#include "diagnosis/possible_tests.hpp"
#include "diagnosis/simulated_fracture.hpp"
#include "diagnosis/test_choice.hpp"

namespace nacre::diagnosis {

/// By test, and model.
using SlopesOfTests = std::map<std::size_t, std::vector<FractureSlopes>>;

/// Predictions by fitted models of tests that are not made yet, and the separation of the models by them.
///
/// The constants of a model that is wrong are refitted once a test is made, and the discretisation error is shared by
/// all moduli: differences of bare predictions promise several times the separation that a test gives. Slopes of moduli
/// and coupons by the constants are computed; those of a fracture test are those of the same design as it was measured,
/// or the mean of the measured ones; of homogeneous specimens they are simulated. A test under a value of a condition
/// that was measured shares the free level of that value, as far as an explanation leaves it free; under a new value it
/// has a level of its own.
class PredictedTests {
 public:
  /// Simulates each test by each of the explanations, which were fitted to the observations of the evidence;
  /// `replicates` of each are made.
  PredictedTests(const Evidence& evidence, const std::vector<Explanation>& explanations,
                 const std::vector<PossibleTest>& tests, int replicates);
  /// For a test and each pair of explanations, the feature that separates them best, and by how many standard errors.
  /// Their square is the growth of the wrong model's chi squared by the test, after its constants are refitted: the
  /// mean of both cases, since either may be the wrong one; where one is the other with effects added, which imitate
  /// any prediction of the other beside the same levels, the growth of that other. No errors: the test gives no
  /// information, or none beyond another replicate of a measured specimen.
  std::vector<Separation> separations(std::size_t test,
                                      const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const;

 private:
  /// A row of a test, conditioned on the measured rows.
  struct NewRow {
    int row = 0;               ///< in added_
    int against = -1;          ///< a row of added_ that it is compared relative to; -1: none
    Eigen::VectorXd whitened;  ///< its covariance with the measured rows
    double variance = 0.0;     ///< when the measured rows are known
  };
  /// An explanation over all rows, measured and added.
  struct Hypothesis {
    FittedModel measured;  ///< the model; the others over the rows of added_
    FittedModel added;
    FreeLevels beside;
    Eigen::MatrixXd levels;                    ///< of the measured and the added rows, one standard deviation each
    Eigen::Index level_count = 0;              ///< the first of them; others are of exponents
    Whitener whitener;                         ///< of the measured rows
    Eigen::VectorXd predicted;                 ///< measured and added rows, with the levels as they are expected
    Eigen::MatrixXd columns;                   ///< FittedModel::whitened_columns()
    Eigen::LDLT<Eigen::MatrixXd> information;  ///< of the free coordinates
  };
  /// A wrong model refitted to the predictions of the measured rows by a true one.
  struct WrongModelRefit {
    Eigen::VectorXd step;  ///< of its coordinates
    Eigen::VectorXd left;  ///< residuals of the rows, whitened
  };

  std::vector<int> add_group(Observation group, const std::vector<FeatureValues>& seen);
  void put_fracture(const FittedModel& model, FittedModel& added, int row, const FeatureValues& seen,
                    const FractureSlopes* slopes) const;
  void put_own_constants(const SlopesOfTests& slopes);
  void join();
  Hypothesis hypothesis_of(const Explanation& explanation, FittedModel added, const NoiseRules& rules) const;
  WrongModelRefit refit(const Hypothesis& truth, const Hypothesis& wrong) const;
  NewRow new_row(int row, const Hypothesis& wrong) const;
  /// Of two rows of joined_.
  double covariance(int row, int other, const Hypothesis& hypothesis) const;
  /// Whether the same design was measured under conditions from which both models predict the same change: a further
  /// replicate, which separates the models no better than it did, unless one is much surer of it. `variance`: the least
  /// of the row by either.
  bool is_replicate(const NewRow& row, double variance, std::size_t a, std::size_t b) const;
  /// Whether one is the other with effects added, beside the same levels.
  static bool holds(const Hypothesis& whole, const Hypothesis& part);
  /// Of chi squared of the wrong model with the row, its constants refitted. `freer`: by how much the variance of the
  /// row is larger by the true model. What that expects elsewhere tells as much as what it predicts; but where it
  /// leaves the level of a new condition open it predicts nothing.
  double growth(const NewRow& row, std::size_t truth, std::size_t wrong, double freer) const;
  /// Whether no measured row has the level of an added one.
  bool has_open_level(int row, const Hypothesis& hypothesis) const;

  Observations measured_;                  ///< without the levels of any explanation
  double same_errors_ = 0.0;               ///< TestRules::same_errors
  Observations added_, joined_;            ///< the tests alone, and behind the measured rows
  std::vector<std::vector<int>> rows_of_;  ///< of each test, in added_
  std::vector<int> first_of_;  ///< per row of added_: of the same pieces on the first of two machines; -1: on one alone
  std::vector<Hypothesis> hypotheses_;
  std::vector<std::vector<WrongModelRefit>> refits_;  ///< by truth and wrong model
};

}  // namespace nacre::diagnosis
