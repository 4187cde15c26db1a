#include "widgets/pqScenePicker.h"

#include "scene/builtin.h"
#include "widgets/scene_properties.h"

#include <vtkSMProperty.h>
#include <vtkSMProxy.h>
#include <vtkSMTrace.h>

#include <QComboBox>
#include <QHBoxLayout>
#include <QIcon>
#include <QListView>

namespace
{
constexpr int PictureSize = 64, SmallPictureSize = 24;

QString Text(std::string_view text)
{
  return QString::fromUtf8(text.data(), int(text.size()));
}
}

pqScenePicker::pqScenePicker(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Box(new QComboBox(this))
{
  this->setProperty(property);
  this->setShowLabel(true);
  this->setChangeAvailableAsChangeFinished(true);

  this->Box->setObjectName("ScenePicker");
  this->Box->setToolTip(tr("Take over the parameters of a built-in scene"));
  this->Box->setIconSize({ SmallPictureSize, SmallPictureSize });
  this->Box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  this->Box->setMinimumContentsLength(12);
  auto* list = new QListView(this->Box); // large pictures, with the title beside
  list->setIconSize({ PictureSize, PictureSize });
  list->setUniformItemSizes(true);
  this->Box->setView(list);

  this->Box->addItem(tr("a built-in scene ..."));
  for (const lamella::BuiltinScene& scene : lamella::builtin_scenes())
  {
    const QString name = Text(scene.name);
    this->Box->addItem(QIcon(":/lamella/pictures/" + name + ".png"),
      QString("%1 (%2)").arg(Text(scene.title), name), name);
  }
  list->setMinimumWidth(list->sizeHintForColumn(0) + 2 * SmallPictureSize);

  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Box);
  QObject::connect(
    this->Box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &pqScenePicker::pick);
}

void pqScenePicker::pick(int index)
{
  const std::string name = this->Box->itemData(index).toString().toStdString();
  if (name.empty())
  {
    return;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->proxy());
  lamella::set_properties(*this->proxy(), lamella::builtin_scene(name));
  Q_EMIT this->changeAvailable();
}
