// Images: a view (pointer, width, height, stride) and an owner of pixels.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

namespace thermedge {

// A rectangle of pixels that it does not own. Passed by value; constness sits in `T`.
// `stride` is the distance between the starts of two rows, in elements. x runs right, y down.
// Camera buffers pass in through it without a copy.
template <class T>
class ImageView {
 public:
  constexpr ImageView() = default;
  constexpr ImageView(T* data, int width, int height, std::ptrdiff_t stride)
      : data_(data), width_(width), height_(height), stride_(stride) {
    assert(width >= 0 && height >= 0 && stride >= width);
  }
  constexpr ImageView(T* data, int width, int height) : ImageView(data, width, height, width) {}

  // A view of mutable pixels converts to a view of constant ones.
  template <class U>
  requires(std::is_const_v<T>&& std::is_same_v<const U, T>) constexpr ImageView(
      ImageView<U> other)  // NOLINT(google-explicit-constructor)
      : ImageView(other.data(), other.width(), other.height(), other.stride()) {}

  [[nodiscard]] constexpr T* data() const { return data_; }
  [[nodiscard]] constexpr int width() const { return width_; }
  [[nodiscard]] constexpr int height() const { return height_; }
  [[nodiscard]] constexpr std::ptrdiff_t stride() const { return stride_; }
  [[nodiscard]] constexpr std::size_t size() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }
  [[nodiscard]] constexpr bool empty() const { return width_ == 0 || height_ == 0; }
  [[nodiscard]] constexpr bool contains(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_;
  }

  [[nodiscard]] constexpr T* row(int y) const {
    assert(y >= 0 && y < height_);
    return data_ + y * stride_;
  }
  [[nodiscard]] constexpr T& operator()(int x, int y) const {
    assert(contains(x, y));
    return data_[y * stride_ + x];
  }

  // The part of this view that starts at (x, y) and is `width` by `height`; must lie inside.
  [[nodiscard]] constexpr ImageView crop(int x, int y, int width, int height) const {
    assert(x >= 0 && y >= 0 && x + width <= width_ && y + height <= height_);
    return {data_ + y * stride_ + x, width, height, stride_};
  }

 private:
  T* data_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

template <class A, class B>
[[nodiscard]] constexpr bool same_size(ImageView<A> a, ImageView<B> b) {
  return a.width() == b.width() && a.height() == b.height();
}

// Copies pixels between views of equal size, converting the type by static_cast.
template <class From, class To>
void copy_pixels(ImageView<From> from, ImageView<To> to) {
  assert(same_size(from, to));
  for (int y = 0; y < from.height(); ++y) {
    std::transform(from.row(y), from.row(y) + from.width(), to.row(y),
                   [](From value) { return static_cast<To>(value); });
  }
}

template <class T>
void fill_pixels(ImageView<T> image, T value) {
  for (int y = 0; y < image.height(); ++y) {
    std::fill_n(image.row(y), image.width(), value);
  }
}

// Owns its pixels. Rows start at 64-byte boundaries and end with at least one spare vector of 64
// bytes, so that a kernel may load whole vectors past the last column. Move-only; `clone()` copies.
// Throws std::bad_alloc where memory runs out (public entry points turn that into a Status).
template <class T>
class Image {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  static constexpr std::size_t kAlignmentBytes = 64;

  Image() = default;
  Image(int width, int height) { resize(width, height); }
  Image(Image&& other) noexcept { swap(other); }
  Image& operator=(Image&& other) noexcept {
    swap(other);
    return *this;
  }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  ~Image() { release(); }

  // Gives the image another size. The pixels are unspecified afterwards. Memory that is large
  // enough is kept, so repeated calls with one size allocate once.
  void resize(int width, int height) {
    assert(width >= 0 && height >= 0);
    const std::size_t stride = stride_for(width);
    const std::size_t needed = stride * static_cast<std::size_t>(height);
    if (needed > capacity_) {
      release();
      data_ =
          static_cast<T*>(::operator new (needed * sizeof(T), std::align_val_t{kAlignmentBytes}));
      capacity_ = needed;
      std::fill_n(data_, needed, T{});
    }
    view_ = ImageView<T>(data_, width, height, static_cast<std::ptrdiff_t>(stride));
  }

  [[nodiscard]] Image clone() const {
    Image copy(width(), height());
    copy_pixels(view(), copy.view());
    return copy;
  }

  [[nodiscard]] ImageView<T> view() { return view_; }
  [[nodiscard]] ImageView<const T> view() const { return view_; }
  operator ImageView<T>() { return view_; }              // NOLINT(google-explicit-constructor)
  operator ImageView<const T>() const { return view_; }  // NOLINT(google-explicit-constructor)

  [[nodiscard]] int width() const { return view_.width(); }
  [[nodiscard]] int height() const { return view_.height(); }
  [[nodiscard]] std::ptrdiff_t stride() const { return view_.stride(); }
  [[nodiscard]] std::size_t size() const { return view_.size(); }
  [[nodiscard]] bool empty() const { return view_.empty(); }
  [[nodiscard]] T* row(int y) { return view_.row(y); }
  [[nodiscard]] const T* row(int y) const { return view_.row(y); }
  [[nodiscard]] T& operator()(int x, int y) { return view_(x, y); }
  [[nodiscard]] const T& operator()(int x, int y) const { return view_(x, y); }

  [[nodiscard]] std::size_t capacity_bytes() const { return capacity_ * sizeof(T); }

  void swap(Image& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    std::swap(view_, other.view_);
  }

 private:
  static std::size_t stride_for(int width) {
    const std::size_t bytes = static_cast<std::size_t>(width) * sizeof(T);
    const std::size_t padded =
        (bytes + kAlignmentBytes - 1) / kAlignmentBytes * kAlignmentBytes + kAlignmentBytes;
    return padded / sizeof(T);
  }
  void release() {
    ::operator delete (data_, std::align_val_t{kAlignmentBytes});
    data_ = nullptr;
    capacity_ = 0;
  }

  T* data_ = nullptr;
  std::size_t capacity_ = 0;  // elements
  ImageView<T> view_;
};

}  // namespace thermedge
