#pragma once
#include "render/picture.h"

#include <QColor>

namespace lamella::render {

inline QColor qt(const Color& c) { return {c.r, c.g, c.b}; }

} // namespace lamella::render
