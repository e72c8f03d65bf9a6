# ruff: noqa: I001 - a line for each module
"""The public names, each where it lives: for type checkers, and for `__init__.py`, which imports what is used."""

from qsbearing import readings as readings
from qsbearing.app.notebook import html_of as html_of, plot as plot
from qsbearing.files.file_errors import FileErrorDetail as FileErrorDetail, SceneFileError as SceneFileError
from qsbearing.files.printed_numbers import catalogue_numbers as catalogue_numbers
from qsbearing.files.scene_file import load_scene as load_scene
from qsbearing.files.set_file import load_set as load_set
from qsbearing.inference.data_sheet import DataSheet as DataSheet
from qsbearing.inference.infer import InferredBearing as InferredBearing, infer_bearing as infer_bearing
from qsbearing.inference.practice import RatingPractice as RatingPractice
from qsbearing.model.contact.hertz import (
    HertzForm as HertzForm,
    PointContact as PointContact,
    point_contact as point_contact,
    subsurface_shear as subsurface_shear,
)
from qsbearing.model.effects import (
    BallDiameterDeviations as BallDiameterDeviations,
    BallExpansion as BallExpansion,
    CentrifugalForce as CentrifugalForce,
    ElasticRings as ElasticRings,
    GyroscopicMoment as GyroscopicMoment,
    MomentShares as MomentShares,
    RingExpansion as RingExpansion,
    RingState as RingState,
    SeatsOutOfRound as SeatsOutOfRound,
)
from qsbearing.model.effects.hertz_angle import HertzAngle as HertzAngle
from qsbearing.model.effects.orbit_radius import OrbitRadius as OrbitRadius
from qsbearing.model.effects.ball_motion import MotionOfBalls as MotionOfBalls
from qsbearing.model.effects.raceway_control import RacewayControl as RacewayControl
from qsbearing.model.effects.tilt_lever import TiltLever as TiltLever
from qsbearing.model.effects.traction import Traction as Traction
from qsbearing.model.effects.traction import TractionLaw as TractionLaw
from qsbearing.model.material import SILICON_NITRIDE as SILICON_NITRIDE, STEEL as STEEL, Material as Material
from qsbearing.model.bearing import BallBearing as BallBearing, BearingKind as BearingKind
from qsbearing.model.operation import Operation as Operation
from qsbearing.model.scene.preload import Preload as Preload
from qsbearing.model.scene.scene import Scene as Scene
from qsbearing.model.solution.raceway_contacts import RacewayContacts as RacewayContacts
from qsbearing.model.solution.solution import Solution as Solution
from qsbearing.model.solution.solver import stiffness as stiffness
from qsbearing.model.solution.status import Reason as Reason, Status as Status
from qsbearing.model.units import (
    GPa as GPa,
    MPa as MPa,
    N as N,
    Nm as Nm,
    Nmm as Nmm,
    Pa as Pa,
    deg as deg,
    kg as kg,
    kg_m3 as kg_m3,
    kN as kN,
    m as m,
    mm as mm,
    mrad as mrad,
    rad as rad,
    rpm as rpm,
    um as um,
    zero_celsius as zero_celsius,
)
from qsbearing.model.validation import ErrorDetail as ErrorDetail, SceneError as SceneError
from qsbearing.model.version import __version__ as __version__
from qsbearing.remarks.of_solution import message as message, warnings as warnings
from qsbearing.results.requirements import requirements as requirements
from qsbearing.studies.chooser.choose import solve as solve
from qsbearing.studies.chooser.choose_set import solve_set as solve_set
from qsbearing.studies.design.compare import compare as compare
from qsbearing.studies.design.find import find as find
from qsbearing.studies.force_table.force_table import force_table as force_table
from qsbearing.studies.sobol import sobol_indices as sobol_indices
from qsbearing.studies.store import open_results as open_results
from qsbearing.studies.study import Study as Study
from qsbearing.studies.sweep import sweep as sweep
from qsbearing.systems.heat.network import Conductance as Conductance, OilFlow as OilFlow, Thermal as Thermal
from qsbearing.systems.rotor_dynamics import (
    stiffness_over_frequency as stiffness_over_frequency,
    stiffness_table as stiffness_table,
    to_ross as to_ross,
)
from qsbearing.systems.rotor_dynamics.ross_bearing import ross_element as ross_element
from qsbearing.systems.sets.bearing_set import BearingSet as BearingSet
from qsbearing.systems.sets.belts import Belt as Belt
from qsbearing.systems.sets.gears import Gear as Gear
from qsbearing.systems.sets.preload_limits import preload_loads as preload_loads, preload_speeds as preload_speeds
from qsbearing.systems.sets.row import Row as Row
from qsbearing.systems.sets.set_solution import SetSolution as SetSolution
from qsbearing.systems.sets.shaft import (
    FloatingGroup as FloatingGroup,
    Housing as Housing,
    HousingStiffness as HousingStiffness,
    Shaft as Shaft,
    ShaftLoad as ShaftLoad,
    ShaftMass as ShaftMass,
    ShaftSection as ShaftSection,
    ShaftSupport as ShaftSupport,
    Spacer as Spacer,
)
from qsbearing.systems.sets.system_life import system_life as system_life
