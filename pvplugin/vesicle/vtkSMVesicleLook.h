/**
 * @class vtkSMVesicleLook
 * @brief values that representations of membranes and phase boundaries begin with
 *
 * Named in the hints of a representation proxy,
 * @code{xml}
 * <InitializationHelper class="vtkSMVesicleLook">
 *   <Property name="LineWidth" values="3"/>
 * </InitializationHelper>
 * @endcode
 * it sets these properties where the user has not.
 */
#ifndef vtkSMVesicleLook_h
#define vtkSMVesicleLook_h

#include "vtkLamellaVesicleModule.h" // for the export macro

#include <vtkSMProxyInitializationHelper.h>

class VTKLAMELLAVESICLE_EXPORT vtkSMVesicleLook : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMVesicleLook* New();
  vtkTypeMacro(vtkSMVesicleLook, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(
    vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMVesicleLook() = default;
  ~vtkSMVesicleLook() override = default;

private:
  vtkSMVesicleLook(const vtkSMVesicleLook&) = delete;
  void operator=(const vtkSMVesicleLook&) = delete;
};

#endif
