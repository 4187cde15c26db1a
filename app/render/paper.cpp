#include "render/paper.h"

#include "render/render.h"
#include "store/atomic_file.h"

#include <QBuffer>
#include <QImage>
#include <QPdfWriter>
#include <QSvgGenerator>
#include <qcustomplot.h>

#include <cmath>
#include <cstring>
#include <span>

namespace lamella::render {
namespace {

namespace fs = std::filesystem;

QImage image_of(const Sheet& sheet, int pixels, Background background) {
  const double scale = pixels / sheet.width();
  QImage image(pixels, int(std::lround(sheet.height() * scale)),
               QImage::Format_RGBA8888_Premultiplied);
  image.fill(background == Background::white ? Qt::white : Qt::transparent);
  QCPPainter painter(&image);
  painter.setMode(QCPPainter::pmNoCaching);
  painter.scale(scale, scale);
  sheet.paint(painter);
  return image;
}

QByteArray png_of(QImage image, double dpi) {
  image.setDotsPerMeterX(int(std::lround(dpi / 0.0254)));
  image.setDotsPerMeterY(image.dotsPerMeterX());
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (!image.save(&buffer, "PNG")) throw RenderError("a picture could not be encoded as PNG");
  return bytes;
}

void paint_vectors(QPaintDevice& device, const Sheet& sheet) {
  QCPPainter painter(&device);
  painter.setModes(QCPPainter::pmVectorized | QCPPainter::pmNoCaching | QCPPainter::pmNonCosmetic);
  sheet.paint(painter);
}

QByteArray pdf_of(const Sheet& sheet) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setCreator("lamella");
  writer.setResolution(int(units_per_inch));
  const QSizeF inches(sheet.width() / units_per_inch, sheet.height() / units_per_inch);
  writer.setPageSize(QPageSize(inches, QPageSize::Inch, {}, QPageSize::ExactMatch));
  writer.setPageMargins(QMarginsF());
  paint_vectors(writer, sheet);
  return bytes;
}

QByteArray svg_of(const Sheet& sheet) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setResolution(int(units_per_inch));
  const QSizeF size(sheet.width(), sheet.height());
  generator.setSize(size.toSize());
  generator.setViewBox(QRectF(QPointF(), size));
  generator.setTitle("lamella");
  paint_vectors(generator, sheet);
  return bytes;
}

void write(const fs::path& file, const QByteArray& bytes) {
  write_atomically(file, std::as_bytes(std::span(bytes.constData(), std::size_t(bytes.size()))));
}

} // namespace

Picture print(const Sheet& sheet, int pixels, Background background) {
  const QImage image = image_of(sheet, pixels, background);
  Picture picture{image.width(), image.height(),
                  std::vector<Color>(std::size_t(image.width()) * image.height())};
  for (int y = 0; y < picture.height; ++y)
    std::memcpy(&picture.pixels[std::size_t(y) * picture.width], image.constScanLine(y),
                std::size_t(picture.width) * sizeof(Color));
  return picture;
}

void write_sheet(const fs::path& file, const Sheet& sheet, double dpi, Background background) {
  const std::string extension = file.extension();
  if (extension == ".png")
    write(file, png_of(image_of(sheet, int(std::lround(sheet.width() / units_per_inch * dpi)),
                                background),
                       dpi));
  else if (extension == ".pdf")
    write(file, pdf_of(sheet));
  else if (extension == ".svg")
    write(file, svg_of(sheet));
  else
    throw RenderError(file.string() + ": not a kind of page; allowed: .png, .pdf, .svg");
}

void write_png(const fs::path& file, const Picture& picture, double dpi) {
  const QImage image(reinterpret_cast<const uchar*>(picture.pixels.data()), picture.width,
                     picture.height, QImage::Format_RGBA8888_Premultiplied);
  write(file, png_of(image.copy(), dpi));
}

} // namespace lamella::render
