#pragma once

class vtkTextProperty;

namespace lamella::render {

enum class Face { regular, bold, oblique };

/// Set the type to DejaVu Sans, which has the Greek letters and superscripts that VTK's own fonts
/// lack. False where it is not installed (Debian: fonts-dejavu-core): VTK's Arial is set instead,
/// and texts must go through plain().
bool set_face(vtkTextProperty& property, Face face);

} // namespace lamella::render
