#include "app/gui/design/fields/RubberFields.h"

#include "app/gui/design/fields/FieldText.h"

#include <QObject>

namespace palp {

namespace {

QString inWords(const char* words) {
  return QObject::tr(words);
}

/// The law of another kind that is as stiff at rest.
RubberLaw lawAsStiff(std::size_t kind, double mu) {
  switch (static_cast<RubberLawKind>(kind)) {
  case RubberLawKind::MooneyRivlin:
    return MooneyRivlin{0.4 * mu, 0.1 * mu}; // the paper's ratio
  case RubberLawKind::NeoHooke:
    return NeoHooke{mu / 2};
  case RubberLawKind::Yeoh:
    return Yeoh{mu / 2, 0, 0};
  case RubberLawKind::Gent:
    return Gent{.mu_MPa = mu};
  case RubberLawKind::Ogden:
    return Ogden{{mu}, {2}};
  }
  return {};
}

DesignField rubberLaw() {
  // In the order of RubberLaw's alternatives.
  const std::vector<DesignChoice> choices{
      {inWords("Mooney-Rivlin"), inWords("W = C10 (I1 - 3) + C01 (I2 - 3), the paper's law")},
      {inWords("neo-Hooke"), inWords("W = C10 (I1 - 3)")},
      {inWords("Yeoh"), inWords("W = C10 (I1 - 3) + C20 (I1 - 3)^2 + C30 (I1 - 3)^3")},
      {inWords("Gent"), inWords("W = -(mu Jm / 2) ln(1 - (I1 - 3) / Jm): the rubber locks where I1 - 3 comes to Jm")},
      {inWords("Ogden"), inWords("W = sum of 2 mu / alpha^2 (l1^alpha + l2^alpha + l3^alpha - 3) over 1 to 3 terms")}};
  return {
      "material.law",
      inWords("Rubber"),
      inWords("law"),
      "",
      inWords(
          "Law of the rubber; another law begins with the same shear modulus. palp material fit finds the constants "
          "from a test."),
      [choices](const SensorDesign& design) { return choices[design.material.law.index()].words; },
      [choices](SensorDesign& design, const QString& words) {
        std::size_t index = 0;
        const QString wrong = setChoice(index, choices, words);
        if (!wrong.isEmpty() || index == design.material.law.index()) return wrong;
        design.material.law = lawAsStiff(index, design.material.shearModulus_MPa());
        return wrong;
      },
      choices};
}

double* c10Of(RubberLaw& law) {
  if (auto* of = std::get_if<MooneyRivlin>(&law)) return &of->c10_MPa;
  if (auto* of = std::get_if<NeoHooke>(&law)) return &of->c10_MPa;
  if (auto* of = std::get_if<Yeoh>(&law)) return &of->c10_MPa;
  return nullptr;
}

/// A constant that its laws have as one number; null: the design's law has none.
DesignField rubberConstant(const QString& key, const QString& label, const QString& unit, const QString& tip,
                           double* (*constant)(RubberLaw&)) {
  return {"material." + key,
          inWords("Rubber"),
          label,
          unit,
          tip,
          [constant](SensorDesign design) {
            const double* value = constant(design.material.law);
            return value != nullptr ? fieldText(*value) : QString();
          },
          [constant](SensorDesign& design, const QString& words) {
            double* value = constant(design.material.law);
            return value != nullptr ? setNumber(*value, words) : QString();
          },
          {},
          [constant](const SensorDesign& design) {
            RubberLaw law = design.material.law;
            return constant(law) != nullptr;
          }};
}

/// Numbers of Ogden's terms.
DesignField ogdenList(const QString& key, const QString& label, const QString& unit, const QString& tip,
                      std::vector<double> Ogden::*part) {
  return {"material." + key,
          inWords("Rubber"),
          label,
          unit,
          tip,
          [part](const SensorDesign& design) {
            const auto* law = std::get_if<Ogden>(&design.material.law);
            return law != nullptr ? listText(law->*part) : QString();
          },
          [part](SensorDesign& design, const QString& words) {
            auto* law = std::get_if<Ogden>(&design.material.law);
            return law != nullptr ? setList(law->*part, words) : QString();
          },
          {},
          [](const SensorDesign& design) { return std::holds_alternative<Ogden>(design.material.law); }};
}

/// mu is one number of Gent's law and a list of Ogden's.
DesignField rubberModulus() {
  DesignField field =
      ogdenList("mu_MPa", "mu", "MPa",
                inWords("Gent: shear modulus, above 0. Ogden: 1 to 3 numbers separated by commas, their sum "
                        "is the shear modulus."),
                &Ogden::mu_MPa);
  const DesignField ofOgden = field;
  field.text = [ofOgden](const SensorDesign& design) {
    const auto* law = std::get_if<Gent>(&design.material.law);
    return law != nullptr ? fieldText(law->mu_MPa) : ofOgden.text(design);
  };
  field.set = [ofOgden](SensorDesign& design, const QString& words) {
    auto* law = std::get_if<Gent>(&design.material.law);
    return law != nullptr ? setNumber(law->mu_MPa, words) : ofOgden.set(design, words);
  };
  field.onlyOf = [ofOgden](const SensorDesign& design) {
    return std::holds_alternative<Gent>(design.material.law) || ofOgden.has(design);
  };
  return field;
}

} // namespace

std::vector<DesignField> rubberLawFields() {
  std::vector<DesignField> fields;
  fields.push_back(rubberLaw());
  fields.push_back(rubberConstant("c10_MPa", "c10", "MPa", inWords("Constant C10, above 0"), c10Of));
  fields.push_back(rubberConstant("c01_MPa", "c01", "MPa",
                                  inWords("Mooney-Rivlin constant C01; C10 + C01 must be above 0"), [](RubberLaw& law) {
                                    auto* of = std::get_if<MooneyRivlin>(&law);
                                    return of != nullptr ? &of->c01_MPa : nullptr;
                                  }));
  fields.push_back(rubberConstant("c20_MPa", "c20", "MPa", inWords("Yeoh's constant C20"), [](RubberLaw& law) {
    auto* of = std::get_if<Yeoh>(&law);
    return of != nullptr ? &of->c20_MPa : nullptr;
  }));
  fields.push_back(rubberConstant("c30_MPa", "c30", "MPa", inWords("Yeoh's constant C30"), [](RubberLaw& law) {
    auto* of = std::get_if<Yeoh>(&law);
    return of != nullptr ? &of->c30_MPa : nullptr;
  }));
  fields.push_back(rubberModulus());
  fields.push_back(rubberConstant("jm", "Jm", "", inWords("Gent's limit of I1 - 3, above 0"), [](RubberLaw& law) {
    auto* of = std::get_if<Gent>(&law);
    return of != nullptr ? &of->jm : nullptr;
  }));
  fields.push_back(
      ogdenList("alpha", "alpha", "", inWords("Ogden's exponents, as many as mu has numbers; not 0"), &Ogden::alpha));
  return fields;
}

} // namespace palp
