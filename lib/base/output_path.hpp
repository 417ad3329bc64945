#pragma once
// Where results go is tried before the work is done whose results they are.

#include <initializer_list>
#include <string>

namespace nacre {

/// Makes the folders above `file` and proves that it can be written, leaving one that is there as it is. Throws
/// InputError naming the path and the system's reason; also for a folder, a device, a pipe.
void prepare_output_file(const std::string& file);
/// The same for a command that also reads `others` (empty: not given): none of them may be written over, nor a CSV file
/// in one that is a folder: a measurement set's.
void prepare_output_file(const std::string& file, std::initializer_list<std::string> others);

/// Makes `folder` with its parents and proves that files can be made in it. Throws InputError.
void prepare_output_folder(const std::string& folder);

}  // namespace nacre
