"""constant/couplingProperties of CFDEMcoupling: which entry is which of ours."""

import re
from typing import Any, Iterable

from clepsydra.cfdem_cases import foam_text
from clepsydra.cfdem_cases.report import Report

# Entry -> the values for which there is nothing to do. None: any.
WITHOUT_COUNTERPART = {
    "syncMode": None,
    "debug": None,
    "verbose": None,
    "locateModel": None,
    "averagingModel": None,
    "clockModel": None,
    "IOModel": None,
    "turbulenceModelType": None,  # what it names is looked at in constant/
    "meshMotionModel": ["noMeshMotion"],
    "regionModel": ["allRegion"],
    "probeModel": ["off"],
    "dataExchangeModel": ["twoWayMPI"],
    "checkPeriodicCells": ["off", "false", "no"],
}
SAME_FORCES = (
    "Archimedes",
    "gradPForce",
    "viscForce",
    "virtualMassForce",
    "DiFeliceDrag",
    "GidaspowDrag",
    "KochHillDrag",
    "BeetstraDrag",
    "RongDrag",
    "SchillerNaumannDrag",
)
ONLY_IN_MODEL_A = ("gradPForce", "viscForce")
# Models that a term of the equations has -> the word that leaves the term out, and what that means.
TERMS = {
    tuple(name for name in SAME_FORCES if name.endswith("Drag")): ("noDrag", "without drag"),
    ("gradPForce",): ("noPressureGradient", "without the pressure gradient on the particles"),
    ("viscForce",): ("noViscousStress", "without the viscous stress on the particles"),
    ("Archimedes",): (
        "noBuoyancy",
        "without buoyancy, which is right only where the fluid is much lighter than the particles",
    ),
}
OTHER_NAMES = {"MeiLift": "SaffmanLiftForce"}
DIAGNOSTICS = (
    "volWeightedAverage",
    "totalMomentumExchange",
    "particleCellVolume",
    "particleVolume",
    "fieldTimeAverage",
    "fieldStore",
    "checkCouplingInterval",
)
# Words of a model's Props
NAMES_OF_FIELDS = (
    "velFieldName",
    "velocityFieldName",
    "granVelFieldName",
    "voidfractionFieldName",
    "densityFieldName",
    "gravityFieldName",
    "pFieldName",
    "pressureFieldName",
    "minAlphaP",
)
NOTHING_TO_DO = (
    "verbose",
    "suppressProbe",
    "interpolation",
    "implForceDEM",
    "implForceDEMaccumulated",
    "lowerLimit",
    "upperLimit",
    "treeSearch",
    "forceSubModels",
    "maxNumberOfParticles",  # of the exchange by files, and of arrays of old versions
    "rhoParticle",  # of filtered drag, which is refused
)
PROPS = re.compile(r"Props\d*\)?$")  # also of a pattern: (twoWayMPIProps|M2MProps)
ONE = ("phi", "scaleUpVol", "scaleDia", "scaleDrag", "scale", "weight")
PARCEL_RATIO = ("scale", "scaleDia")  # of a force: the word of CFDEMcoupling 3 and that of earlier versions
SWITCHED_OFF = ("off", "false", "no")


class Settings:
    """What the rest of the import needs to know; `entries` are those of the new file."""

    def __init__(self, old: foam_text.Dictionary, report: Report) -> None:
        self.old, self.report, self.where = old, report, old.where
        self.interval_in_steps = old.number("couplingInterval")
        self.script = self.script_of("twoWayMPI")
        self.without_counterpart()
        self.entries: dict[str, Any] = {
            "fluid": "incompressible",
            "modelType": self.one_of("modelType", ("A", "B")),
            "voidFractionModel": self.one_of("voidFractionModel", ("divided", "centre")),
        }
        self.void_fraction_props()
        self.smoothing()
        self.forces()
        self.entries["momCoupleModels"] = f"( {' '.join(self.momentum_models())} )"
        self.dilation()
        self.other_props()

    def script_of(self, exchange: str) -> str:
        props = self.old.sub(f"{exchange}Props")
        self.plain_words(props)
        return props.needed("liggghtsPath").strip('"')

    def without_counterpart(self) -> None:
        for name, harmless in WITHOUT_COUNTERPART.items():
            if name in self.old:
                value = self.old.text(name).strip('"')
                if harmless is None or value in harmless:
                    self.report.left_out(self.where, f"{name} {value}".strip(), "has no counterpart")
                else:
                    self.report.error(self.where, name, f"is '{value}'; allowed: {', '.join(harmless)}")

    def one_of(self, name: str, allowed: Iterable[str]) -> str:
        value = self.old.needed(name).strip('"')
        if value not in allowed:
            self.report.error(self.where, name, f"is '{value}'; allowed: {', '.join(allowed)}")
        return value

    def void_fraction_props(self) -> None:
        model = self.old.text("voidFractionModel").strip('"')
        props = self.old.sub(f"{model}Props")
        self.plain_words(props)
        if "alphaMin" in props:
            self.entries[f"{self.entries['voidFractionModel']}Props"] = {"alphaMin": props.text("alphaMin")}

    def smoothing(self) -> None:
        model = self.one_of("smoothingModel", ("off", "constDiffSmoothing"))
        self.entries["smoothingModel"] = model
        if model != "constDiffSmoothing":
            return
        props = self.old.sub("constDiffSmoothingProps")
        self.plain_words(props)
        length = props.number("smoothingLength")
        self.entries["constDiffSmoothingProps"] = {"bandwidth": f"{2 * length:.10g}"}
        self.report.change(
            self.where,
            f"smoothingLength {length:g}",
            (
                f"is a bandwidth of {2 * length:g} m here: the standard deviation is sqrt(2) smoothingLength there "
                "(one implicit step of diffusion) and bandwidth/sqrt(2) here, which is the same"
            ),
        )

    def forces(self) -> None:
        chosen = []
        self.parcel_ratios: dict[str, float] = {}
        for name in self.old.words("forceModels"):
            if name in DIAGNOSTICS:
                self.report.left_out(
                    self.where, name, "a diagnostic; the conservation check in the log has volume and momentum"
                )
                self.old.sub(f"{name}Props").is_read()
                continue
            if name not in SAME_FORCES and name not in OTHER_NAMES:
                self.report.error(
                    self.where,
                    name,
                    f"is not among the forces here; allowed: {', '.join([*SAME_FORCES, *OTHER_NAMES])}",
                )
                continue
            chosen.append(OTHER_NAMES.get(name, name))
            if name in OTHER_NAMES:
                self.report.change(self.where, name, f"is {OTHER_NAMES[name]} here")
            self.force_props(name)
        self.coarse_graining()
        words = self.left_out_of(chosen)
        self.entries["forceModels"] = f"( {' '.join([*chosen, *words])} )"

    def coarse_graining(self) -> None:
        """One ratio for all forces here: CFDEMcoupling has one in each model's Props."""
        ratios = sorted(set(self.parcel_ratios.values()))
        if len(ratios) > 1:
            given = ", ".join(f"{name} {ratio:g}" for name, ratio in self.parcel_ratios.items())
            self.report.error(self.where, " or ".join(PARCEL_RATIO), f"differs ({given}); allowed: the same everywhere")
        elif ratios and ratios[0] != 1:
            self.entries["coarseGraining"] = f"{ratios[0]:.10g}"
            self.report.change(
                self.where,
                f"scale {ratios[0]:g}",
                (
                    f"is coarseGraining {ratios[0]:g} here: all forces on a parcel are those on one of its particles "
                    "times their number, and the script gives the parcels' diameter"
                ),
            )

    def left_out_of(self, chosen: list[str]) -> list[str]:
        """The words for terms of the equations that the old case does not have. What no equation has is removed."""
        words = []
        for models, (word, meaning) in TERMS.items():
            of_term = [name for name in chosen if name in models]
            contained = self.entries["modelType"] == "B" and models[0] in ONLY_IN_MODEL_A
            for name in of_term if contained else of_term[1:]:
                chosen.remove(name)
                why = "the drag of model B contains it" if contained else f"its force adds to that of {of_term[0]}"
                self.report.error(self.where, name, f"{why}; allowed: without it")
            if not contained and not of_term:
                words.append(word)
                lacks = "no drag law" if word == "noDrag" else f"no {models[0]}"
                self.report.change(self.where, "forceModels", f"has {lacks}, so {word} is added: {meaning}, as before")
        return words

    def force_props(self, name: str) -> None:
        props = self.old.sub(f"{name}Props")
        for word in PARCEL_RATIO:
            if word in props:
                self.parcel_ratios[name] = props.number(word)
        self.plain_words(props, may_differ_from_one=PARCEL_RATIO)
        if props.text("interpolation") not in (None, *SWITCHED_OFF):
            self.report.left_out(
                props.where,
                "interpolation",
                "the fluid at a particle is always the mean over the cells on which the particle acts",
            )

    def plain_words(self, props: foam_text.Dictionary, may_differ_from_one: tuple[str, ...] = ()) -> None:
        """Those that need nothing done, and those that must have the value for which nothing need be done."""
        for name in (*NAMES_OF_FIELDS, *NOTHING_TO_DO):
            props.text(name)
        for name in ONE:
            if name in props and props.number(name) != 1 and name not in may_differ_from_one:
                self.report.error(props.where, name, f"is {props.number(name):g}; allowed: 1, it has no counterpart")
        for name in (
            "treatForceExplicit",
            "treatForceDEM",
            "scalarViscosity",
            "useFilteredDragModel",
            "useParcelSizeDependentFilteredDrag",
            "explicitCorr",
        ):
            if name in props and props.text(name) not in SWITCHED_OFF:
                self.report.error(props.where, name, "is on; allowed: off, it has no counterpart")

    def momentum_models(self) -> list[str]:
        models = self.old.words("momCoupleModels")
        for name in models:
            if name not in ("implicitCouple", "explicitCouple"):
                self.report.error(self.where, name, "is not known here; allowed: implicitCouple, explicitCouple")
            self.plain_words(self.old.sub(f"{name}Props"))
        if len(models) == 2:
            self.report.change(
                self.where,
                "momCoupleModels",
                "one model here, implicitCouple: it gives the reactions of all forces to the fluid",
            )
            return ["implicitCouple"]
        return models

    def dilation(self) -> None:
        """In CFDEMcoupling off where the word is missing."""
        on = "useDDTvoidfraction" in self.old and self.old.text("useDDTvoidfraction") not in SWITCHED_OFF
        self.entries["useDDTvoidfraction"] = "on" if on else "off"
        if not on:
            self.report.change(
                self.where,
                "useDDTvoidfraction",
                (
                    "off, as in the old case; where particles move, on is right, with "
                    "useDDTvoidfractionProps { smoothingTime } of a few milliseconds"
                ),
            )

    def other_props(self) -> None:
        """Of models that are not chosen: nobody read them there either."""
        for name, value in self.old.entries.items():
            if PROPS.search(name) and name not in self.old.asked and isinstance(value, foam_text.Dictionary):
                self.old.asked.add(name)
                value.is_read()
                self.report.left_out(self.where, name, "of a model that is not chosen")
