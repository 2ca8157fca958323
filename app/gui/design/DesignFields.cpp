#include "app/gui/design/DesignFields.h"

#include "app/gui/design/fields/FieldText.h"
#include "app/gui/design/fields/RubberFields.h"

#include <QObject>

#include <algorithm>
#include <array>
#include <cassert>

namespace palp {

namespace {

template <class Part>
DesignField number(const QString& key, const QString& group, const QString& label, const QString& unit,
                   const QString& tip, Part part) {
  return {key,
          group,
          label,
          unit,
          tip,
          [part](SensorDesign design) { return fieldText(part(design)); },
          [part](SensorDesign& design, const QString& words) { return setNumber(part(design), words); }};
}

template <class Part>
DesignField list(const QString& key, const QString& group, const QString& label, const QString& tip, Part part) {
  return {key,
          group,
          label,
          "mm",
          tip,
          [part](SensorDesign design) { return listText(part(design)); },
          [part](SensorDesign& design, const QString& words) { return setList(part(design), words); }};
}

template <class Part>
DesignField lists(const QString& key, const QString& group, const QString& label, const QString& tip, Part part) {
  return {key,
          group,
          label,
          "mm",
          tip,
          [part](SensorDesign design) { return listsText(part(design)); },
          [part](SensorDesign& design, const QString& words) { return setLists(part(design), words); }};
}

template <class Part>
DesignField count(const QString& key, const QString& group, const QString& label, const QString& tip, Part part) {
  return {key,
          group,
          label,
          "",
          tip,
          [part](SensorDesign design) { return QString::number(part(design)); },
          [part](SensorDesign& design, const QString& words) { return setCount(part(design), words); }};
}

using D = SensorDesign;
using Fields = std::vector<DesignField>;

QString tr(const char* words) {
  return QObject::tr(words);
}

const std::array<QString, 3>& axes() {
  static const std::array<QString, 3> names{"x", "y", "z"};
  return names;
}

/// Block, rubber and load areas.
void addBody(Fields& fields) {
  for (int d = 0; d < 3; ++d)
    fields.push_back(number(QString("block_mm[%1]").arg(d), tr("Block"),
                            tr("size along %1").arg(axes()[static_cast<std::size_t>(d)]), "mm",
                            tr("Length of the block's side, above 0; the bottom face is fixed"),
                            [d](D& s) -> double& { return s.block_mm[d]; }));
  for (const DesignField& field : rubberLawFields()) fields.push_back(field);
  fields.push_back(
      number("material.poisson_ratio", tr("Rubber"), tr("Poisson's ratio"), "",
             tr("0 to 0.5, which is incompressible; it sets the bulk modulus kappa = mu / (1 - 2 nu) with "
                "the shear modulus mu at rest, for Mooney-Rivlin d = (1 - 2 nu) / (C10 + C01) as in ANSYS"),
             [](D& s) -> double& { return s.material.poissonRatio; }));
  fields.push_back(number("material.density_t_per_mm3", tr("Rubber"), tr("density"), "t/mm3",
                          tr("Density of the rubber, above 0"),
                          [](D& s) -> double& { return s.material.density_t_per_mm3; }));
  fields.push_back(count("areas.columns", tr("Load areas"), tr("along x"), tr("Number of load areas along x, 1 to 50"),
                         [](D& s) -> int& { return s.areas.columns; }));
  fields.push_back(count("areas.rows", tr("Load areas"), tr("along y"), tr("Number of load areas along y, 1 to 50"),
                         [](D& s) -> int& { return s.areas.rows; }));
}

void addElectrodeLayers(Fields& fields) {
  fields.push_back(list("upper_layer.row_wire_y_mm", tr("Upper layer"), tr("row-wires at y"),
                        tr("One number per row-wire; evenly spaced wires as 1.5, 4.5, ..., 28.5"),
                        [](D& s) -> std::vector<double>& { return s.upper.wire_mm; }));
  fields.push_back(lists("upper_layer.electrode_x_mm", tr("Upper layer"), tr("electrodes at x"),
                         tr("One list for all row-wires, or one list per row-wire separated by ;"),
                         [](D& s) -> std::vector<std::vector<double>>& { return s.upper.along_mm; }));
  fields.push_back(lists("upper_layer.z_mm", tr("Upper layer"), tr("height z"),
                         tr("Height above the bottom of the block: one number for all, or one list per row-wire"),
                         [](D& s) -> std::vector<std::vector<double>>& { return s.upper.z_mm; }));
  fields.push_back(list("lower_layer.column_wire_x_mm", tr("Lower layer"), tr("column-wires at x"),
                        tr("One number per column-wire; evenly spaced wires as 0.5, 1.5, ..., 29.5"),
                        [](D& s) -> std::vector<double>& { return s.lower.wire_mm; }));
  fields.push_back(lists("lower_layer.electrode_y_mm", tr("Lower layer"), tr("electrodes at y"),
                         tr("One list for all column-wires, or one list per column-wire separated by ;"),
                         [](D& s) -> std::vector<std::vector<double>>& { return s.lower.along_mm; }));
  fields.push_back(lists("lower_layer.z_mm", tr("Lower layer"), tr("height z"),
                         tr("Height above the bottom of the block, below the upper layer: one number for all, or one "
                            "list per column-wire"),
                         [](D& s) -> std::vector<std::vector<double>>& { return s.lower.z_mm; }));
}

/// A number of one of the laws.
template <class Law>
DesignField ofLaw(const QString& key, const QString& label, const QString& unit, const QString& tip,
                  double Law::*part) {
  return {"resistance." + key,
          resistanceGroup(),
          label,
          unit,
          tip,
          [part](const SensorDesign& design) {
            const Law* law = std::get_if<Law>(&design.resistance);
            return law != nullptr ? fieldText(law->*part) : QString();
          },
          [part](SensorDesign& design, const QString& words) {
            Law* law = std::get_if<Law>(&design.resistance);
            return law != nullptr ? setNumber(law->*part, words) : QString();
          },
          {},
          [](const SensorDesign& design) { return std::holds_alternative<Law>(design.resistance); }};
}

DesignField law() {
  // In the order of ResistanceLaw's alternatives.
  const std::vector<DesignChoice> choices{
      {tr("Eq. (1), independent pairs"), tr("The paper's law: each pair of an upper and a lower electrode is a "
                                            "resistor g x distance, independent of all other wires")},
      {tr("conduction field"),
       tr("One conduction field in the rubber connects all electrodes; the readings depend on the read-out circuit")}};
  return {"resistance.law",
          resistanceGroup(),
          tr("law"),
          "",
          tr("How resistances follow from the positions of the electrodes"),
          [choices](const SensorDesign& design) { return choices[design.resistance.index()].words; },
          [choices](SensorDesign& design, const QString& words) {
            std::size_t index = 0;
            const QString wrong = setChoice(index, choices, words);
            if (!wrong.isEmpty() || index == design.resistance.index()) return wrong;
            design.resistance = index == 0 ? ResistanceLaw(PairsLaw{}) : ResistanceLaw(FieldLaw{});
            return wrong;
          },
          choices};
}

DesignField readout() {
  // In the order of Readout.
  const std::vector<DesignChoice> choices{
      {tr("floating"), tr("One row-wire is driven against one column-wire; all other wires float. The current also "
                          "takes the metal of other wires as a short cut through the block.")},
      {tr("virtual ground"), tr("One row-wire is driven; all column-wires and all other row-wires are held at 0 V, and "
                                "the current of each column-wire is read, as with a transimpedance amplifier.")},
      {tr("rows grounded"), tr("One row-wire is driven and all other row-wires are held at 0 V; the current of one "
                               "column-wire at 0 V is read while the others float, as with a plain multiplexer.")},
      {tr("others at half"), tr("One row-wire is driven and the current of one column-wire at 0 V is read, while all "
                                "other wires are held at half of the drive voltage.")}};
  return {"resistance.readout",
          resistanceGroup(),
          tr("read-out"),
          "",
          tr("Voltages of the wires while one row-wire and one column-wire are read"),
          [choices](const SensorDesign& design) {
            const FieldLaw* field = design.field();
            return field != nullptr ? choices[static_cast<std::size_t>(field->readout)].words : QString();
          },
          [choices](SensorDesign& design, const QString& words) {
            FieldLaw* field = std::get_if<FieldLaw>(&design.resistance);
            if (field == nullptr) return QString();
            auto index = static_cast<std::size_t>(field->readout);
            const QString wrong = setChoice(index, choices, words);
            field->readout = static_cast<Readout>(index);
            return wrong;
          },
          choices,
          [](const SensorDesign& design) { return design.field() != nullptr; }};
}

/// The law first: the others are its numbers.
void addResistance(Fields& fields) {
  fields.push_back(law());
  fields.push_back(ofLaw("rate_ohm_per_mm", tr("rate g"), "ohm/mm",
                         tr("Above 0; a pair of electrodes has R = g x distance"), &PairsLaw::rate_ohm_per_mm));
  fields.push_back(ofLaw("resistivity_ohm_mm", tr("resistivity"), "ohm mm",
                         tr("Resistivity of the rubber, above 0; isotropic, also where the rubber is deformed"),
                         &FieldLaw::resistivity_ohm_mm));
  fields.push_back(ofLaw("electrode_radius_mm", tr("electrode radius"), "mm",
                         tr("Above 0 and below half of the smallest gap between electrodes. An electrode is modelled "
                            "as a small sphere, which is accurate up to 0.35 of the gap."),
                         &FieldLaw::electrodeRadius_mm));
  fields.push_back(ofLaw("contact_ohm_mm2", tr("contact"), "ohm mm2",
                         tr("Contact resistance times the electrode's surface, 0 or more"),
                         &FieldLaw::contact_ohm_mm2));
  fields.push_back(ofLaw("wire_ohm", tr("wire and switch"), "ohm",
                         tr("Resistance of a wire and of its switch on the board, outside of the block, 0 or more"),
                         &FieldLaw::wire_ohm));
  fields.push_back(readout());
}

void addForces(Fields& fields) {
  for (int d = 0; d < 3; ++d) {
    const QString& axis = axes()[static_cast<std::size_t>(d)];
    fields.push_back(number("force_range_N." + axis, tr("Force range"), tr("F%1 from").arg(axis), "N",
                            tr("Force range of the samples; errors in % of range refer to it"),
                            [d](D& s) -> double& { return s.forceRange.low_N[d]; }));
    fields.push_back(number("force_range_N." + axis, tr("Force range"), tr("F%1 to").arg(axis), "N",
                            tr("Force range of the samples; errors in % of range refer to it"),
                            [d](D& s) -> double& { return s.forceRange.high_N[d]; }));
  }
}

Fields makeFields() {
  Fields fields;
  addBody(fields);
  addElectrodeLayers(fields);
  addResistance(fields);
  addForces(fields);
  return fields;
}

} // namespace

const std::vector<DesignField>& designFields() {
  static const std::vector<DesignField> fields = makeFields();
  return fields;
}

QString resistanceGroup() {
  return tr("Resistance");
}

const DesignField& designField(const QString& key) {
  const auto found = std::find_if(designFields().begin(), designFields().end(),
                                  [&](const DesignField& field) { return field.key == key; });
  assert(found != designFields().end() && "the key is one of the design's fields");
  return *found;
}

} // namespace palp
