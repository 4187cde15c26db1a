/**
 * @class vtkSMVesicleTrace
 * @brief what a trace needs to run again: that the plugin is loaded
 *
 * Named in the hints of every source and filter of the plugin,
 * @code{xml}
 * <InitializationHelper class="vtkSMVesicleTrace"/>
 * @endcode
 * it writes that into a trace before the first of them.
 */
#ifndef vtkSMVesicleTrace_h
#define vtkSMVesicleTrace_h

#include "vtkLamellaVesicleModule.h" // for the export macro

#include <vtkSMProxyInitializationHelper.h>

class VTKLAMELLAVESICLE_EXPORT vtkSMVesicleTrace : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMVesicleTrace* New();
  vtkTypeMacro(vtkSMVesicleTrace, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(
    vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMVesicleTrace() = default;
  ~vtkSMVesicleTrace() override = default;

private:
  vtkSMVesicleTrace(const vtkSMVesicleTrace&) = delete;
  void operator=(const vtkSMVesicleTrace&) = delete;
};

#endif
