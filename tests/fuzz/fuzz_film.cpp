// Fracture films.

#include "film/film_file.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const auto film = film::decode(fuzz::text_of(data, size));
  if (film) fuzz::expect(film::decode(film::encode(*film)).has_value());
  return 0;
}
