"""Constants of the shape memory alloy rig and its static equilibrium, in SI units and degC; plain Python."""

from typing import NamedTuple


class Physics(NamedTuple):
    """Constants; the rig tells their meaning and source. Of a metre of wire where the unit is per metre."""

    ambient: float
    resistance: float  # ohm m
    jacket_heat_capacity: float  # J/(m K)
    wire_heat_capacity: float  # J/(m K)
    convection: float  # W/(m K)
    latent_rise: float  # latent heat over specific heat of the body that transforms, K
    wire_lag: float
    sensor_lag: float
    martensite_finish: float
    martensite_start: float
    austenite_start: float
    austenite_finish: float
    martensite_slope: float  # Pa/K
    austenite_slope: float  # Pa/K
    martensite_modulus: float
    austenite_modulus: float
    transformation_strain: float
    length: float
    section: float  # m^2
    prestress: float
    radius: float
    anchor_stiffness: float
    torsion_stiffness: float


def mechanics(martensite: float, k: Physics) -> tuple[float, float]:
    """Static equilibrium of two wires on elastic anchors and a torsion spring.

    martensite : fraction in the driven wire, [0, 1]; the other wire stays martensite
    -> stress of the driven wire in Pa, rotation in rad (0 at martensite = 1)

    Driven   length (stress / E + strain martensite) + section stress / anchor = constant - radius rotation
    Passive  the same with + radius rotation and martensite = 1
    Torque   radius section (driven stress - passive stress) = torsion rotation
    """
    modulus = k.austenite_modulus + martensite * (k.martensite_modulus - k.austenite_modulus)
    anchor = k.section / k.anchor_stiffness
    driven = k.length / modulus + anchor
    passive = k.length / k.martensite_modulus + anchor
    stretch = k.prestress * passive + k.length * k.transformation_strain * (1.0 - martensite)
    stiffness = k.torsion_stiffness + k.radius**2 * k.section * (1.0 / driven + 1.0 / passive)
    rotation = k.radius * k.section * (stretch / driven - k.prestress) / stiffness
    return (stretch - k.radius * rotation) / driven, rotation
