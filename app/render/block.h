#pragma once
#include "render/plot.h"
#include "render/sheet.h"
#include "render/studio.h"

#include <memory>
#include <string>
#include <vector>

namespace lamella::render {

/// What views are taken with, and how finely.
struct Camera {
  Studio& studio;
  double pixels = 0.75; ///< per unit of the sheet; 300 per inch
};

/// A part of a page, which takes the width that it is given.
class Block {
public:
  virtual ~Block() = default;
  virtual double height(double width) const = 0;
  /// Throws RenderError.
  virtual void draw(Sheet& sheet, const Box& place, Camera camera) const = 0;
};

/// A letter and a title at the upper left corner of a block; either may be empty.
struct Heading {
  std::string letter, title;

  double height() const;
  void draw(Sheet& sheet, const Box& place) const;
};

class PlotBlock : public Block {
public:
  PlotBlock(Heading heading, Plot plot) : heading_(std::move(heading)), plot_(std::move(plot)) {}
  double height(double width) const override;
  void draw(Sheet& sheet, const Box& place, Camera camera) const override;

private:
  Heading heading_;
  Plot plot_;
};

/// Cells as text. All columns but the first are set to the right.
using TableCells = std::vector<std::vector<std::string>>;

class TableBlock : public Block {
public:
  /// `heads`: rows above the rule.
  TableBlock(Heading heading, TableCells cells, std::size_t heads)
      : heading_(std::move(heading)), cells_(std::move(cells)), heads_(heads) {}
  double height(double width) const override;
  void draw(Sheet& sheet, const Box& place, Camera camera) const override;

private:
  Heading heading_;
  TableCells cells_;
  std::size_t heads_;
};

/// A paragraph in small type.
class TextBlock : public Block {
public:
  explicit TextBlock(std::string text) : text_(std::move(text)) {}
  double height(double width) const override;
  void draw(Sheet& sheet, const Box& place, Camera camera) const override;

private:
  std::string text_;
};

/// Blocks side by side, as wide as their weights say, and rows of them below each other.
class Page {
public:
  explicit Page(double width) : width_(width) {}
  struct Part {
    std::unique_ptr<Block> block;
    double weight = 1;
  };
  /// `weights`: of a whole row; the parts may fill less.
  void add_row(std::vector<Part> parts, double weights);
  void add(std::unique_ptr<Block> block);
  /// Throws RenderError.
  Sheet draw(Camera camera) const;

private:
  struct Row {
    std::vector<Part> parts;
    double weights;
  };
  double width_;
  std::vector<Row> rows_;
};

} // namespace lamella::render
