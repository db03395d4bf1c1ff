"""Taylor bars: a cylinder against a rigid plane, with large strain, rate hardening and adiabatic softening.

Source: 42CrMo4 at 287 m/s: OpenRadioss on the same meshes (tests/reference/taylor_42crmo4) and DynELA (Pantalé:
length 26.5 mm). OFHC copper: experiments of Johnson & Cook 1983, and what codes give with their constants: length
ratio 0.685, foot diameter 14.2 to 14.6 mm at 190 m/s.

The reference's "final length" is the distance of the bar's free end from the plane, and at 80 µs the bar has
rebounded: in both codes the rim of its foot is 0.8 mm off the plane. From end to end the bar is as long as DynELA's,
so that the 2.6 % between the two codes is a matter of definition. Plastic strain at the foot is not converged on the
coarse mesh and follows the resistance to hourglassing: with twice the stiffness it is that of the reference's
element, which resists more; with the solver's own it is nearer to what both codes give on the fine mesh.
"""

import numpy as np
import pytest
from bars import Bar, crush
from references import columns, figures, rms

from peenflow.case.model import Constants, JohnsonCookConstants
from peenflow.materials.library import material

FOLDER = "taylor_42crmo4"
COARSE = Bar(32.4e-3, 3.2e-3, core=5, ring=5, layers=80)
FINE = Bar(32.4e-3, 3.2e-3, core=9, ring=9, layers=150)
COPPER = Bar(25.4e-3, 3.81e-3, core=5, ring=5, layers=64)
FINE_COPPER = Bar(25.4e-3, 3.81e-3, core=9, ring=9, layers=128)
LATER = 80e-6
DYNELA_LENGTH = 26.5
EXPERIMENTS = {130.0: 0.770, 146.0: 0.736, 190.0: 0.638}


def steel(bar, **controls):
    return crush(bar, material("steel-42crmo4", Constants(), JohnsonCookConstants()), 287.0, LATER, **controls)


def copper(bar, speed):
    return crush(bar, material("ofhc-copper", Constants(), JohnsonCookConstants()), speed, LATER)


def balanced(rung, found):
    rung.below("energy error", found.energy_error, 0.01)
    rung.below("hourglass over internal energy", found.hourglass, 0.05)


def shape(rung, found, mesh):
    reference, profile = figures(f"{FOLDER}/results_{mesh}.csv"), columns(f"{FOLDER}/profile_{mesh}.csv")
    rung.near("free end from the plane", 1e3 * found.end, reference["final_length_mm"], "mm", rel=0.02)
    rung.near("length of the bar (DynELA)", 1e3 * found.length, DYNELA_LENGTH, "mm", rel=0.02)
    rung.near("foot's rim from the plane", 1e3 * found.z[0], profile["z_mm"][0], "mm", abs=0.05)
    rung.near("foot radius", 1e3 * found.foot_radius, reference["foot_radius_mm"], "mm", rel=0.02)
    skin = np.interp(profile["z_mm"], 1e3 * found.z, 1e3 * found.skin)
    apart = rms(skin - profile["outer_radius_mm"]) / (1e3 * COARSE.radius)
    rung.below("skin's profile, rms over the initial radius", apart, 0.02)
    rung.curve(f"taylor_{mesh}", z=found.z, skin=found.skin, axis=found.axis_z, peeq=found.axis_peeq)
    balanced(rung, found)


def test_steel_on_the_coarse_mesh(rung):
    found, same, fine = steel(COARSE), figures(f"{FOLDER}/results_coarse.csv"), figures(f"{FOLDER}/results_fine.csv")
    assert COARSE.elements == same["elements"]
    shape(rung, found, "coarse")
    rung.near("largest PEEQ (reference's fine mesh)", found.peeq, fine["PEEQ_max"], rel=0.10)
    rung.near("highest temperature (reference's fine mesh)", found.temperature, fine["T_max_K"], "K", rel=0.10)
    rung.note("largest PEEQ (reference's same mesh)", found.peeq, same["PEEQ_max"])
    rung.note("highest temperature (reference's same mesh)", found.temperature, same["T_max_K"], "K")


def test_twice_the_hourglass_stiffness_gives_the_strain_of_the_references_element(rung):
    found, same = steel(COARSE, hourglass_stiffness=0.1), figures(f"{FOLDER}/results_coarse.csv")
    rung.near("largest PEEQ", found.peeq, same["PEEQ_max"], rel=0.10)
    rung.near("highest temperature", found.temperature, same["T_max_K"], "K", rel=0.10)


@pytest.mark.long
def test_steel_on_the_fine_mesh(rung):
    found, same = steel(FINE), figures(f"{FOLDER}/results_fine.csv")
    assert FINE.elements == same["elements"]
    shape(rung, found, "fine")
    rung.near("largest PEEQ", found.peeq, same["PEEQ_max"], rel=0.10)
    rung.near("highest temperature", found.temperature, same["T_max_K"], "K", rel=0.10)


def test_copper_at_190_m_s(rung):
    found = copper(COPPER, 190.0)
    ratio = found.length / COPPER.length
    rung.near("final over initial length (codes)", ratio, 0.685, rel=0.02)
    rung.note("final over initial length (experiment)", ratio, EXPERIMENTS[190.0])
    balanced(rung, found)


@pytest.mark.long
@pytest.mark.parametrize("speed", EXPERIMENTS, ids=lambda speed: f"{speed:g} m/s")
def test_copper_on_the_fine_mesh(rung, speed):
    found = copper(FINE_COPPER, speed)
    ratio = found.length / COPPER.length
    # Codes with these constants end 7 % longer than the experiment at 190 m/s; no figures of theirs at the others.
    rung.near("final over initial length (experiment)", ratio, EXPERIMENTS[speed], rel=0.08)
    if speed == 190.0:
        rung.near("final over initial length (codes)", ratio, 0.685, rel=0.02)
        rung.between("foot diameter", 2e3 * found.foot_radius, 14.2, 14.6, "mm")
    balanced(rung, found)
