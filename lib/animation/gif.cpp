#include "animation/gif.hpp"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::animation {
namespace {

constexpr int kColours = 255;  // the 256th is for points that stay as they were
constexpr GifByteType kUnchanged = 255;
constexpr int kSampledPictures = 12;

int channel(std::uint32_t rgb, int shift) { return rgb >> shift & 0xff; }

int distance(std::uint32_t a, std::uint32_t b) {
  int sum = 0;
  for (const int shift : {16, 8, 0}) {
    const int difference = channel(a, shift) - channel(b, shift);
    sum += difference * difference;
  }
  return sum;
}

/// Colours of the GIF, and the one that each colour of a picture takes.
class Palette {
 public:
  void count(const Picture& picture) {
    for (const std::uint32_t rgb : picture.rgb) ++counts_[rgb];
  }

  void choose() {
    std::vector<std::pair<long, std::uint32_t>> commonest;
    for (const auto& [rgb, count] : counts_) commonest.emplace_back(-count, rgb);
    std::sort(commonest.begin(), commonest.end());
    for (const auto& [count, rgb] : commonest)
      if (colours_.size() < kColours) colours_.push_back(rgb);
  }

  GifByteType index(std::uint32_t rgb) {
    const auto [known, is_new] = nearest_.try_emplace(rgb, 0);
    if (!is_new) return known->second;
    int best = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < colours_.size(); ++i)
      if (const int d = distance(colours_[i], rgb); d < best) {
        best = d;
        known->second = static_cast<GifByteType>(i);
      }
    return known->second;
  }

  std::array<GifColorType, 256> table() const {
    std::array<GifColorType, 256> table{};
    for (std::size_t i = 0; i < colours_.size(); ++i)
      table[i] = {static_cast<GifByteType>(channel(colours_[i], 16)), static_cast<GifByteType>(channel(colours_[i], 8)),
                  static_cast<GifByteType>(channel(colours_[i], 0))};
    return table;
  }

 private:
  std::unordered_map<std::uint32_t, long> counts_;
  std::vector<std::uint32_t> colours_;
  std::unordered_map<std::uint32_t, GifByteType> nearest_;
};

/// giflib writing into memory. Every call that fails throws, with giflib's reason.
class GifEncoder {
 public:
  GifEncoder(int width, int height, const Palette& palette) {
    int error = 0;
    file_ = EGifOpen(this, append, &error);
    if (file_ == nullptr) throw InputError(GifErrorString(error));
    EGifSetGifVersion(file_, true);
    const std::array<GifColorType, 256> table = palette.table();
    const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> map(GifMakeMapObject(256, table.data()),
                                                                           &GifFreeMapObject);
    check(EGifPutScreenDesc(file_, width, height, 8, 0, map.get()));
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    constexpr std::array<GifByteType, 3> kForever = {1, 0, 0};
    check(EGifPutExtensionBlock(file_, 3, kForever.data()));
    check(EGifPutExtensionTrailer(file_));
  }
  ~GifEncoder() {
    int error = 0;
    if (file_ != nullptr) EGifCloseFile(file_, &error);
  }
  GifEncoder(const GifEncoder&) = delete;
  GifEncoder& operator=(const GifEncoder&) = delete;

  /// The part of a picture between the given points (right and bottom excluded).
  void add(const std::vector<GifByteType>& indices, int width, int left, int top, int right, int bottom, int delay) {
    const GraphicsControlBlock control{
        .DisposalMode = DISPOSE_DO_NOT, .UserInputFlag = false, .DelayTime = delay, .TransparentColor = kUnchanged};
    std::array<GifByteType, 4> block{};
    EGifGCBToExtension(&control, block.data());
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, 4, block.data()));
    check(EGifPutImageDesc(file_, left, top, right - left, bottom - top, false, nullptr));
    std::vector<GifPixelType> line(right - left);
    for (int y = top; y < bottom; ++y) {
      std::copy_n(indices.begin() + y * width + left, line.size(), line.begin());
      check(EGifPutLine(file_, line.data(), right - left));
    }
  }

  std::string finish() {
    int error = 0;
    const int status = EGifCloseFile(std::exchange(file_, nullptr), &error);
    if (status != GIF_OK) throw InputError(GifErrorString(error));
    return std::move(bytes_);
  }

 private:
  static int append(GifFileType* file, const GifByteType* bytes, int count) {
    static_cast<GifEncoder*>(file->UserData)
        ->bytes_.append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
  }
  void check(int status) const {
    if (status != GIF_OK) throw InputError(GifErrorString(file_->Error));
  }
  GifFileType* file_ = nullptr;
  std::string bytes_;
};

std::string encoded(const Gif& gif) {
  Palette palette;
  const int step = std::max(1, gif.frame_count / kSampledPictures);
  Picture picture;
  for (int i = 0; i < gif.frame_count; i += step) palette.count(picture = gif.draw(i));
  palette.choose();
  const int width = picture.width, height = picture.height;
  GifEncoder encoder(width, height, palette);
  std::vector<GifByteType> shown(picture.rgb.size(), kUnchanged), changes(picture.rgb.size());
  for (int i = 0; i < gif.frame_count; ++i) {
    picture = gif.draw(i);
    int left = width, top = height, right = 0, bottom = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto at = static_cast<std::size_t>(y * width + x);
        const GifByteType index = palette.index(picture.rgb[at]);
        changes[at] = index == shown[at] ? kUnchanged : index;
        if (index == shown[at]) continue;
        shown[at] = index;
        left = std::min(left, x), right = std::max(right, x + 1), top = std::min(top, y),
        bottom = std::max(bottom, y + 1);
      }
    // A picture without changes still takes its time: one point of it.
    if (right == 0) left = top = 0, right = bottom = 1;
    encoder.add(changes, width, left, top, right, bottom, gif.hundredths_of_seconds(i));
  }
  return encoder.finish();
}

}  // namespace

void write_gif(const std::filesystem::path& path, const Gif& gif) {
  std::string bytes;
  try {
    bytes = encoded(gif);
  } catch (const InputError& problem) {
    throw InputError::format("{}: {}", path.string(), problem.what());
  }
  write_file_atomically(path, bytes);
}

}  // namespace nacre::animation
