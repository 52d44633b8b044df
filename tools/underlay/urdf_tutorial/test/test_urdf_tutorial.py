# SPDX-License-Identifier: Apache-2.0
"""The models, which build up step by step, and how the launch file shows them."""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree

from launch import LaunchContext
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.utilities import perform_substitutions
import pytest
from urdf import parse_urdf
from urdf.robot_model import RobotModel
import xacro

PACKAGE = Path(__file__).parents[1]
STEPS = sorted((PACKAGE / 'urdf').glob('*.urdf'))
MACROS = PACKAGE / 'urdf' / '08-macroed.urdf.xacro'


def model(path: Path) -> RobotModel:
    """Read a model."""
    return parse_urdf(path.read_text(), str(path))


def properties(element: ElementTree.Element) -> dict[str, float | str]:
    """Return all attributes of an element and those below it, by their places."""
    found: dict[str, float | str] = {}
    for child in element:
        key = child.tag + child.get('name', '')
        for name, text in child.attrib.items():
            for number, word in enumerate(text.split()):
                try:
                    value: float | str = float(word)
                except ValueError:
                    value = word
                if (child.tag, value) != ('origin', 0.0):  # the default
                    found[f'{key}.{name}.{number}'] = value
        found.update({f'{key}/{name}': value for name, value in properties(child).items()})
    return found


def test_each_step_adds_to_the_one_before() -> None:
    """The models have the names of the tutorial; each has the links of the one before."""
    assert [path.stem for path in STEPS] == [
        *('01-myfirst', '02-multipleshapes', '03-origins', '04-materials'),
        *('05-visual', '06-flexible', '07-physics'),
    ]
    models = [model(path) for path in STEPS]
    names = [{link.name for link in each.links} for each in models]
    assert all(before <= after for before, after in zip(names, names[1:]))
    assert {each.root for each in models} == {'base_link'}
    kinds = [{joint.kind for joint in each.moving_joints} for each in models]
    assert kinds == [set()] * 5 + [{'continuous', 'prismatic', 'revolute'}] * 2
    assert all(link.collisions and link.mass for link in models[-1].links)


def test_the_cart_stands_on_the_ground() -> None:
    """Its wheels and its caster reach equally deep."""
    below = {joint.child: joint.origin.xyz[2] for joint in model(STEPS[-1]).joints}
    radii = {'left_wheel': 0.09, 'right_wheel': 0.09, 'caster': 0.045}
    assert [below[name] - radius for name, radius in radii.items()] == pytest.approx([-0.17] * 3)


def test_macros_make_the_same_cart() -> None:
    """The xacro file describes the cart of the step before, up to rounding."""
    expanded = ElementTree.fromstring(xacro.process_file(str(MACROS)).toxml())
    written = ElementTree.parse(STEPS[-1]).getroot()
    assert properties(expanded) == {
        name: pytest.approx(value, rel=1e-4, abs=1e-8) if isinstance(value, float) else value
        for name, value in properties(written).items()
    }
    inertia = written.find("link[@name='head']/inertial/inertia")
    assert inertia is not None and math.isclose(float(inertia.get('ixx', '')), 0.4 * 0.6 * 0.08**2)


@pytest.mark.parametrize('given', [{'gui': 'false'}, {'jsp_gui': 'false', 'model': '/a.urdf'}])
def test_the_launch_file_passes_on_what_it_is_given(given: dict[str, str]) -> None:
    """Sliders have two names, as in older and newer tutorials; the model may be anywhere."""
    context = LaunchContext()
    context.launch_configurations.update(given)
    path = str(PACKAGE / 'launch' / 'display.launch.py')
    description = AnyLaunchDescriptionSource(path).get_launch_description(context)
    for entity in description.entities:
        if isinstance(entity, DeclareLaunchArgument) and entity.name != 'rvizconfig':
            entity.execute(context)
    include = description.entities[-1]
    assert isinstance(include, IncludeLaunchDescription)
    passed = dict(include.launch_arguments)
    assert passed['urdf_package'] == 'urdf_tutorial'
    values = {
        name: perform_substitutions(context, [passed[name]])
        for name in ('urdf_package_path', 'jsp_gui')
    }
    model = given.get('model', 'urdf/01-myfirst.urdf')
    assert values == {'urdf_package_path': model, 'jsp_gui': 'false'}
