#pragma once
// Several runs behind one address: the page's files, the list of runs, and for each its dashboard. `/runs/NAME` before
// an address means that run; an address without it the first one that can be read.

#include <filesystem>
#include <string>
#include <vector>

#include "dashboard/dashboard.hpp"
#include "dashboard/http.hpp"
#include "dashboard/page_files.hpp"

namespace nacre::dashboard {

/// A run and who responds for it.
struct ShownRun {
  std::string name;                ///< in addresses
  Dashboard* dashboard = nullptr;  ///< nullptr: it cannot be read
  std::string problem = {};        ///< why not
};

/// Responds to requests from any number of threads.
class SeveralRuns {
 public:
  /// `page_folder`: as built from web/. The dashboards, one at least, must outlive it.
  SeveralRuns(const std::filesystem::path& page_folder, std::vector<ShownRun> runs);
  /// Never throws. A name in an address is compared with those of the runs, and never leads to a file.
  Response handle(const Request& request);

 private:
  Response list();
  Response of_run(Request request);
  Response of_first(const Request& request);
  PageFiles page_;
  std::vector<ShownRun> runs_;
};

}  // namespace nacre::dashboard
