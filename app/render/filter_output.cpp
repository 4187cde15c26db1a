#include "render/filter_output.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

namespace lamella::render {

FilterOutput output_of(vtkPolyDataAlgorithm& filter, vtkImageData& image) {
  FilterOutput output;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&output);
  listener->SetCallback([](vtkObject*, unsigned long event, void* to, void* message) {
    FilterOutput& said = *static_cast<FilterOutput*>(to);
    (event == vtkCommand::ErrorEvent ? said.error : said.warning) =
        static_cast<const char*>(message);
  });
  filter.AddObserver(vtkCommand::ErrorEvent, listener);
  filter.AddObserver(vtkCommand::WarningEvent, listener);
  filter.SetInputData(&image);
  filter.Update();
  filter.RemoveObserver(listener);
  output.data = filter.GetOutput();
  return output;
}

} // namespace lamella::render
