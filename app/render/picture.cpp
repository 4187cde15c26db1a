#include "render/picture.h"

#include "render/render.h"
#include "store/atomic_file.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <span>

namespace lamella::render {
namespace {

namespace fs = std::filesystem;

std::vector<unsigned char> encode_png(const Picture& picture) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* row = static_cast<Color*>(image->GetScalarPointer());
  for (int y = picture.height - 1; y >= 0; --y, row += picture.width) // VTK's rows go up
    std::copy_n(&picture.at(0, y), picture.width, row);

  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray* bytes = writer->GetResult();
  if (writer->GetErrorCode() != 0 || !bytes || bytes->GetNumberOfValues() == 0)
    throw RenderError("a picture could not be encoded as PNG");
  const unsigned char* first = writer->GetResult()->GetPointer(0);
  return {first, first + bytes->GetNumberOfValues()};
}

} // namespace

Picture reduce(const Picture& picture, int factor) {
  Picture small{picture.width / factor, picture.height / factor, {}};
  small.pixels.resize(std::size_t(small.width) * small.height);
  const int count = factor * factor;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      int r = count / 2, g = count / 2, b = count / 2; // rounds to the nearest
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) {
          const Color& c = picture.at(x * factor + i, y * factor + j);
          r += c.r, g += c.g, b += c.b;
        }
      using Byte = unsigned char;
      small.pixels[std::size_t(y) * small.width + x] = {Byte(r / count), Byte(g / count),
                                                        Byte(b / count)};
    }
  return small;
}

void write_png(const fs::path& file, const Picture& picture) {
  const std::vector<unsigned char> bytes = encode_png(picture);
  write_atomically(file, std::as_bytes(std::span(bytes)));
}

} // namespace lamella::render
