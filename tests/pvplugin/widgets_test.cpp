// The panel of the plugin's sources, without a display.
#include "scene/builtin.h"
#include "scene/scene_toml.h"

#include <pqApplicationCore.h>
#include <pqInterfaceTracker.h>
#include <pqObjectBuilder.h>
#include <pqPVApplicationCore.h>
#include <pqPluginManager.h>
#include <pqPropertyWidget.h>
#include <pqProxyWidget.h>
#include <pqServer.h>
#include <pqServerResource.h>
#include <pqStandardPropertyWidgetInterface.h>

#include <vtkAlgorithm.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSmartPointer.h>

#include <QApplication>
#include <QComboBox>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

namespace lamella {
namespace {

using testing::HasSubstr;

class Panel : public testing::Test {
protected:
  static void SetUpTestSuite() {
    server_ = pqApplicationCore::instance()->getObjectBuilder()->createServer(
        pqServerResource("builtin:"));
    QString error;
    ASSERT_EQ(pqApplicationCore::instance()->getPluginManager()->loadExtension(
                  server_, LAMELLA_PLUGIN, &error, false),
              pqPluginManager::LOADED)
        << error.toStdString();
  }

  Panel()
      : vesicle(vtk::TakeSmartPointer(server_->proxyManager()->NewProxy("sources", "Vesicle"))),
        panel(vesicle), picker(panel.findChild<QComboBox*>("ScenePicker")) {}

  void pick(const BuiltinScene& scene) {
    picker->setCurrentIndex(
        picker->findData(QString::fromUtf8(scene.name.data(), int(scene.name.size()))));
    panel.apply();
  }

  bool shows(const char* property) {
    auto* widget = panel.findChild<pqPropertyWidget*>(property);
    return widget && !widget->isHidden();
  }

  static pqServer* server_;
  vtkSmartPointer<vtkSMProxy> vesicle;
  pqProxyWidget panel;
  QComboBox* picker;
};

pqServer* Panel::server_ = nullptr;

TEST_F(Panel, OffersEveryBuiltinSceneWithItsPicture) {
  ASSERT_TRUE(picker);
  ASSERT_EQ(picker->count(), 1 + int(builtin_scenes().size()));
  for (int n = 1; n < picker->count(); ++n)
    EXPECT_FALSE(picker->itemIcon(n).pixmap(64, 64).isNull())
        << "pvplugin/pictures has no picture of " << picker->itemData(n).toString().toStdString();
}

TEST_F(Panel, TakesOverAllOfAScene) {
  for (const BuiltinScene& builtin : builtin_scenes()) {
    pick(builtin);
    Scene scene = builtin_scene(builtin.name);
    scene.name = scene.title = "";
    auto* source = vtkAlgorithm::SafeDownCast(vesicle->GetClientSideObject());
    source->UpdateInformation();
    std::ostringstream text;
    source->Print(text);
    EXPECT_THAT(text.str(), HasSubstr(to_toml(scene)));
  }
}

TEST_F(Panel, ShowsWhatApplies) {
  panel.filterWidgets(true);
  EXPECT_TRUE(shows("ShapeSemiAxis"));
  EXPECT_TRUE(shows("BendingModulus"));
  for (const char* name : {"ShapeRadius", "LineTension", "LdBendingModulus", "VolumeTargets"})
    EXPECT_FALSE(shows(name)) << name;
  pick(builtin_scenes()[std::size_t(
      std::ranges::find(builtin_scenes(), std::string_view("fig15a"), &BuiltinScene::name) -
      builtin_scenes().begin())]);
  panel.filterWidgets(true);
  for (const char* name : {"ShapeRadius", "LineTension", "LdBendingModulus", "VolumeTargets"})
    EXPECT_TRUE(shows(name)) << name;
  for (const char* name : {"ShapeSemiAxis", "BendingModulus", "VolumePressure"})
    EXPECT_FALSE(shows(name)) << name;
}

} // namespace
} // namespace lamella

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  QApplication application(count, arguments);
  pqPVApplicationCore core(count, arguments);
  pqInterfaceTracker* interfaces = core.interfaceTracker();
  interfaces->addInterface(new pqStandardPropertyWidgetInterface(interfaces)); // decorators
  return RUN_ALL_TESTS();
}
