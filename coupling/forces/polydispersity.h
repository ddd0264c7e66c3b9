#pragma once

#include "closures/polydisperseDrag.h"
#include "modelLines.h"
#include "runTimeSelection.h"

#include <tuple>

namespace clepsydra
{

inline const ModelLines polydispersities = std::apply(
    [](const auto&... law) {
        return ModelLines("<drag law>Props { polydispersity }",
            {{"none", "the particle's own diameter, whatever the size of the others (the default)"},
                {law.name, law.line}...});
    },
    closures::PolydispersityLaws{});

/// Drag of a particle among particles of other sizes, from any drag law of beds; see closures/polydisperseDrag.h. Read
/// from the entry `polydispersity` of `<drag law>Props`.
class Polydispersity
{
public:
    /// FatalIOError for an unknown name.
    explicit Polydispersity(const Foam::dictionary& coefficients)
        : name_(coefficients.found("polydispersity")
                    ? selectedModel(coefficients, "polydispersity", polydispersities.names())
                    : Foam::word("none"))
    {
        std::apply([&](const auto&... law) { (select(law), ...); }, closures::PolydispersityLaws{});
    }

    bool isOn() const
    {
        return law_ != nullptr;
    }

    const Foam::word& name() const
    {
        return name_;
    }

    /// Diameter with which the drag law is evaluated [m].
    /// \param sauterMean  around the particle [m]; 0 where it has not been sampled, i.e. without fluid
    double diameterForLaw(double own, double sauterMean) const
    {
        return isOn() && sauterMean > 0 ? sauterMean : own;
    }

    /// Sp of the particle [kg/s].
    /// \param ofEqualSpheres  the drag law's value for a particle whose diameter is diameterForLaw() [kg/s]
    /// \param particle  with its own diameter
    double coefficient(double ofEqualSpheres, double diameterForLaw, const closures::ParticleInFluid& particle) const
    {
        if (!isOn())
        {
            return ofEqualSpheres;
        }
        const double y = particle.diameter / diameterForLaw;
        const double stokes = closures::stokesCoefficient(particle);
        return stokes * law_(y, particle.voidFraction, y * ofEqualSpheres / stokes);
    }

private:
    template<class Law>
    void select(const Law& law)
    {
        if (name_ == law.name)
        {
            law_ = [](double y, double voidFraction, double f) { return Law{}(y, voidFraction, f); };
        }
    }

    const Foam::word name_;
    double (*law_)(double y, double voidFraction, double f) = nullptr;
};

} // namespace clepsydra
