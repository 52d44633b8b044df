# SPDX-License-Identifier: Apache-2.0
"""Check that check_model passes sound models, and says what is wrong with broken ones."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import subprocess
import sys
from xml.etree import ElementTree

from ament_index_python.packages import get_package_share_directory
from humanoid_description.check_model import main
from humanoid_description.checks import check_robot
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
import pytest

Element = ElementTree.Element
Break = Callable[[Element], None]


def part(robot: Element, path: str) -> Element:
    """Return an element that must exist."""
    found = robot.find(path)
    assert found is not None, path
    return found


def joint(robot: Element, name: str) -> Element:
    """Return the joint of a name."""
    return part(robot, f"joint[@name='{name}']")


def link(robot: Element, name: str) -> Element:
    """Return the link of a name."""
    return part(robot, f"link[@name='{name}']")


def two_roots(robot: Element) -> None:
    """Take away the joint of the camera."""
    robot.remove(joint(robot, 'camera_link_fixed'))


def loop(robot: Element) -> None:
    """Hang the torso from the hand that it carries."""
    part(joint(robot, 'waist_yaw'), 'parent').set('link', 'l_gripper')


def only_a_loop(robot: Element) -> None:
    """Hang the root from a hand."""
    ElementTree.SubElement(robot, 'joint', name='back', type='fixed').extend(
        [Element('parent', link='l_gripper'), Element('child', link='base_link')]
    )


def two_parents(robot: Element) -> None:
    """Hang the left hand from the right one as well."""
    ElementTree.SubElement(robot, 'joint', name='clasp', type='fixed').extend(
        [Element('parent', link='r_gripper'), Element('child', link='l_gripper')]
    )


def unknown_link(robot: Element) -> None:
    """Misspell a parent."""
    part(joint(robot, 'left_elbow'), 'parent').set('link', 'left_uper_arm')


def same_name(robot: Element) -> None:
    """Name two joints alike."""
    joint(robot, 'right_knee').set('name', 'left_knee')


def negative_mass(robot: Element) -> None:
    """Let a shank fly."""
    part(link(robot, 'left_shank'), 'inertial/mass').set('value', '-2.2')


def impossible_inertia(robot: Element) -> None:
    """Give a thigh a moment that is too large for the others."""
    part(link(robot, 'left_thigh'), 'inertial/inertia').set('izz', '1.0')


def negative_inertia(robot: Element) -> None:
    """Give a thigh products of inertia that outweigh the moments."""
    part(link(robot, 'left_thigh'), 'inertial/inertia').set('ixz', '0.5')


def no_body(robot: Element) -> None:
    """Take the mass out of a link that moves."""
    neck = link(robot, 'neck')
    neck.remove(part(neck, 'inertial'))


def exchanged_limits(robot: Element) -> None:
    """Let a knee go from its end to its start."""
    limit = part(joint(robot, 'left_knee'), 'limit')
    limit.set('lower', '2.3')
    limit.set('upper', '0')


def no_limits(robot: Element) -> None:
    """Take the limits from a joint."""
    head = joint(robot, 'head_yaw')
    head.remove(part(head, 'limit'))


def no_effort(robot: Element) -> None:
    """Take the strength from a joint."""
    part(joint(robot, 'head_pitch'), 'limit').set('effort', '0')


def no_axis(robot: Element) -> None:
    """Let a joint turn about nothing."""
    part(joint(robot, 'waist_yaw'), 'axis').set('xyz', '0 0 0')


def unknown_type(robot: Element) -> None:
    """Misspell a type."""
    joint(robot, 'waist_yaw').set('type', 'revolut')


def mimics(follower: str, leader: str) -> Break:
    """Return what lets a joint follow another."""

    def break_it(robot: Element) -> None:
        ElementTree.SubElement(joint(robot, follower), 'mimic', joint=leader)

    return break_it


def circle(robot: Element) -> None:
    """Let two joints follow each other, and a third one of them."""
    for pair in (('head_yaw', 'waist_yaw'), ('waist_yaw', 'head_yaw'), ('head_pitch', 'head_yaw')):
        mimics(*pair)(robot)


def other_frame(robot: Element) -> None:
    """Name a frame as REP 120 does not."""
    link(robot, 'l_wrist').set('name', 'left_wrist')
    for role in ('parent', 'child'):
        for element in robot.findall(f"joint/{role}[@link='l_wrist']"):
            element.set('link', 'left_wrist')


def other_joint(robot: Element) -> None:
    """Name a joint as no controller does."""
    joint(robot, 'left_elbow').set('name', 'left_elbow_pitch')


def longer_leg(robot: Element) -> None:
    """Make one leg longer."""
    part(joint(robot, 'right_ankle_pitch'), 'origin').set('xyz', '0 0 -0.32')


def other_range(robot: Element) -> None:
    """Let the arms roll to the same side."""
    limit, left = (
        part(joint(robot, f'{side}_shoulder_roll'), 'limit') for side in ('right', 'left')
    )
    limit.attrib.update(left.attrib)


def slightly_longer_leg(robot: Element) -> None:
    """Make one leg longer by a tenth of a millimetre."""
    part(joint(robot, 'right_ankle_pitch'), 'origin').set('xyz', '0 0 -0.3001')


def other_strength(robot: Element) -> None:
    """Let one knee be slower."""
    part(joint(robot, 'left_knee'), 'limit').set('velocity', '1.5')


def other_kind(robot: Element) -> None:
    """Let one elbow turn without an end."""
    joint(robot, 'right_elbow').set('type', 'continuous')


def other_centre(robot: Element) -> None:
    """Put the weight of one thigh aside."""
    part(link(robot, 'left_thigh'), 'inertial/origin').set('xyz', '0.01 0 -0.15')


def other_inertia(robot: Element) -> None:
    """Give one thigh another moment."""
    inertia = part(link(robot, 'left_thigh'), 'inertial/inertia')
    inertia.set('ixx', str(1.01 * float(inertia.attrib['ixx'])))


def one_body(robot: Element) -> None:
    """Give one hand a mass, and the other none."""
    link(robot, 'l_gripper').append(part(link(robot, 'left_foot'), 'inertial'))


def third_arm(robot: Element) -> None:
    """Add a link on the left side only."""
    ElementTree.SubElement(robot, 'link', name='left_tail')
    ElementTree.SubElement(robot, 'joint', name='tail', type='fixed').extend(
        [Element('parent', link='base_link'), Element('child', link='left_tail')]
    )


def no_velocity(robot: Element) -> None:
    """Take the speed from a joint."""
    part(joint(robot, 'head_pitch'), 'limit').set('velocity', '0')


def slightly_impossible_inertia(robot: Element) -> None:
    """Give a thigh a moment that is too large by a hundredth."""
    inertia = part(link(robot, 'left_thigh'), 'inertial/inertia')
    inertia.attrib.update(ixx='1', iyy='1', izz='2.02', ixy='0', ixz='0', iyz='0')


def somewhat_heavy_torso(robot: Element) -> None:
    """Make the torso heavier by a thirtieth of the robot."""
    part(link(robot, 'torso'), 'inertial/mass').set('value', '13.4')


def hands_apart(robot: Element) -> None:
    """Let the arms not turn inwards."""
    for side in ('left', 'right'):
        yaw = part(joint(robot, f'{side}_shoulder_yaw'), 'limit')
        yaw.attrib.update(lower='-0.01', upper='0.01')
        roll = part(joint(robot, f'{side}_shoulder_roll'), 'limit')
        lower, upper = ('0.6', '0.7') if side == 'left' else ('-0.7', '-0.6')
        roll.attrib.update(lower=lower, upper=upper)


def heavy_foot(robot: Element) -> None:
    """Make one foot heavier."""
    part(link(robot, 'left_foot'), 'inertial/mass').set('value', '1.5')


def heavy_torso(robot: Element) -> None:
    """Make the torso heavier."""
    part(link(robot, 'torso'), 'inertial/mass').set('value', '20')


def giant(robot: Element) -> None:
    """Put the head on a long neck."""
    part(joint(robot, 'head_pitch'), 'origin').set('xyz', '0 0 0.88')


def leaning(robot: Element) -> None:
    """Put the weight of the torso far in front of the feet."""
    part(link(robot, 'torso'), 'inertial/origin').set('xyz', '0.6 0 0.19')


def no_soles(robot: Element) -> None:
    """Let nothing touch the ground."""
    for side in ('left', 'right'):
        foot = link(robot, f'{side}_foot')
        foot.remove(part(foot, 'collision'))


def stiff_arms(robot: Element) -> None:
    """Let the arms only hang."""
    for side in ('left', 'right'):
        limit = part(joint(robot, f'{side}_shoulder'), 'limit')
        limit.attrib.update(lower='-0.3', upper='0.3')


BROKEN: dict[str, tuple[Break, str]] = {
    'two roots': (two_roots, "There are 2 roots: 'base_link', 'camera_link'. Connect them"),
    'loop': (loop, "lead into a loop, not to a root: 'torso', 'neck', 'head'"),
    'no root': (only_a_loop, 'There is no root: every link has a parent.'),
    'two parents': (
        two_parents,
        "Link 'l_gripper' is the child of several joints: 'l_gripper_fixed', 'clasp'.",
    ),
    'unknown link': (
        unknown_link,
        "The parent of joint 'left_elbow' is 'left_uper_arm', which does not exist. "
        "Did you mean 'left_upper_arm'?",
    ),
    'same name': (same_name, "Several joints are named 'left_knee'."),
    'negative mass': (negative_mass, "Link 'left_shank' has a mass of -2.2 kg."),
    'impossible inertia': (
        impossible_inertia,
        "Link 'left_thigh' has a physically impossible inertia: the largest principal moment, "
        '1 kg m2, exceeds the sum',
    ),
    'negative inertia': (
        negative_inertia,
        "Link 'left_thigh' has a principal moment of inertia of -0.4",
    ),
    'no body': (no_body, "Link 'neck' is moved by joint 'head_yaw', but neither it nor "),
    'exchanged limits': (
        exchanged_limits,
        "Joint 'left_knee' has the lower limit 2.3, which is not below the upper limit 0.",
    ),
    'no limits': (no_limits, "Joint 'head_yaw' is revolute, but has no <limit> with its range"),
    'no effort': (no_effort, "Joint 'head_pitch' has 0 as effort limit"),
    'no axis': (no_axis, "The axis of joint 'waist_yaw' is 0 0 0"),
    'unknown type': (
        unknown_type,
        "Joint 'waist_yaw' has the unknown type 'revolut'. Did you mean 'revolute'?",
    ),
    'unknown leader': (
        mimics('left_elbow', 'right_elbo'),
        "mimics 'right_elbo', which does not exist. Did you mean 'right_elbow'?",
    ),
    'fixed leader': (
        mimics('left_elbow', 'camera_link_fixed'),
        "Joint 'left_elbow' mimics 'camera_link_fixed', which has no position: it is fixed.",
    ),
    'circle': (
        circle,
        "in a loop, so nothing can move them: 'waist_yaw', 'head_yaw', 'head_pitch'.",
    ),
    'other frame': (
        other_frame,
        "The frame 'l_wrist' of REP 120 is missing. Did you mean 'left_wrist'?",
    ),
    'other joint': (
        other_joint,
        "The driven joint 'left_elbow' of config/joints.yaml is missing. "
        "Did you mean 'left_elbow_pitch'?",
    ),
    'longer leg': (
        longer_leg,
        "Joints 'left_ankle_pitch' and 'right_ankle_pitch' are not at mirrored positions: "
        '(0, 0, -0.3) and (0, 0, -0.32).',
    ),
    'slightly longer leg': (slightly_longer_leg, '(0, 0, -0.3) and (0, 0, -0.3001).'),
    'other strength': (
        other_strength,
        "Joints 'left_knee' and 'right_knee' do not have mirrored limits",
    ),
    'other kind': (
        other_kind,
        "Joints 'left_elbow' and 'right_elbow' are of different types, revolute and continuous.",
    ),
    'other centre': (
        other_centre,
        "Links 'left_thigh' and 'right_thigh' do not have mirrored centres of mass",
    ),
    'other inertia': (
        other_inertia,
        "Links 'left_thigh' and 'right_thigh' do not have mirrored inertias.",
    ),
    'one body': (one_body, "Links 'l_gripper' and 'r_gripper': only one of them has a mass."),
    'third arm': (
        third_arm,
        "The link 'left_tail' has no counterpart 'right_tail' on the other side.",
    ),
    'no velocity': (no_velocity, "Joint 'head_pitch' has 0 as velocity limit"),
    'slightly impossible inertia': (slightly_impossible_inertia, 'physically impossible inertia'),
    'somewhat heavy torso': (somewhat_heavy_torso, 'kg; at its height of 1.35 m it should weigh'),
    'hands apart': (hands_apart, 'the hands cannot meet in front of it'),
    'other range': (
        other_range,
        "Joints 'left_shoulder_roll' and 'right_shoulder_roll' do not have mirrored limits",
    ),
    'heavy foot': (
        heavy_foot,
        "Links 'left_foot' and 'right_foot' have different masses, 1.5 and 1 kg.",
    ),
    'heavy torso': (
        heavy_torso,
        'The robot weighs 50.80 kg; at its height of 1.35 m it should weigh 42.80 kg.',
    ),
    'giant': (giant, 'The robot is 2.20 m tall; this build is designed for 0.68 to 1.76 m.'),
    'leaning': (leaning, 'outside the support polygon'),
    'no soles': (no_soles, 'There is no flat surface to stand on'),
    'stiff arms': (stiff_arms, 'The left hand reaches only'),
}


@pytest.mark.parametrize('scale', ['0.5', '0.65', '1.0', '1.3'])
@pytest.mark.parametrize('more', [[], ['--hands'], ['--upper-body-only', '--prefix', 'r1_']])
def test_humanoid_is_sound(
    scale: str, more: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """The humanoid passes every check in every size, whole or without legs."""
    assert main(['--scale', scale, *more]) == 0
    which = {
        0: 'The humanoid',
        1: 'The humanoid with hands',
        3: "The upper body of the humanoid with the prefix 'r1_'",
    }[len(more)]
    verdict = f'{which} at scale {float(scale):g} is sound: 19 checks passed.\n'
    assert capsys.readouterr().out.endswith(verdict)


@pytest.mark.parametrize('name', BROKEN)
def test_broken_model(name: str, urdf: str) -> None:
    """Each defect gets its sentence."""
    break_it, sentence = BROKEN[name]
    robot = ElementTree.fromstring(urdf)
    break_it(robot)
    text = ElementTree.tostring(robot, encoding='unicode')
    outcomes = check_robot(load_robot(text, 'broken.urdf'))
    defects = [defect for outcome in outcomes for defect in outcome.defects]
    assert any(sentence in defect for defect in defects), defects


def test_visuals_that_are_all_meshes(urdf: str) -> None:
    """The height is that of the collision shapes."""
    robot = ElementTree.fromstring(urdf)
    for geometry in robot.iterfind('link/visual/geometry'):
        geometry[:] = [Element('mesh', filename='https://example.org/a.stl')]
    text = ElementTree.tostring(robot, encoding='unicode')
    found = {each.title: each.found for each in check_robot(load_robot(text, 'meshes.urdf'))}
    assert float(found['height'].split()[0]) == pytest.approx(1.35, abs=0.2)


def test_broken_model_with_prefix() -> None:
    """The sides are compared also when all names begin with something else."""
    robot = ElementTree.fromstring(humanoid_urdf(prefix='r1_'))
    part(link(robot, 'r1_left_foot'), 'inertial/mass').set('value', '1.5')
    outcomes = check_robot(load_robot(ElementTree.tostring(robot, encoding='unicode'), 'r1.urdf'))
    assert any(
        "Links 'r1_left_foot' and 'r1_right_foot'" in d for o in outcomes for d in o.defects
    )


def test_broken_file(urdf: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A defect ends the program with 1, and is printed below the table with the verdict."""
    path = tmp_path / 'broken.urdf'
    path.write_text(urdf.replace('<mass value="6.0"/>', '<mass value="0"/>'))
    assert main([str(path)]) == 1
    out = capsys.readouterr().out
    assert ": Link 'base_link' has a mass of 0 kg." in out
    assert out.endswith(f'{path} has 1 defect: 9 checks passed, 9 skipped.\n')


def test_other_robot(capsys: pytest.CaptureFixture[str]) -> None:
    """What makes sense for the humanoid only is skipped for other robots, with the reason."""
    share = get_package_share_directory('robot_description')
    assert main([f'{share}/urdf/simple_arm.urdf']) == 0
    out = capsys.readouterr().out
    assert out.count("skipped: the robot 'simple_arm' is not the humanoid") == 1
    assert '\n9 more ' in out
    assert out.endswith('is sound: 10 checks passed, 9 skipped.\n')


def test_xacro_file(capsys: pytest.CaptureFixture[str]) -> None:
    """A xacro file is expanded before it is checked."""
    share = get_package_share_directory('humanoid_description')
    assert main([f'{share}/urdf/humanoid.urdf.xacro']) == 0
    assert 'is sound' in capsys.readouterr().out


def test_arguments_of_a_xacro_file(capsys: pytest.CaptureFixture[str]) -> None:
    """What follows a xacro file goes on to xacro, which warns of what nothing takes."""
    file = f'{get_package_share_directory("humanoid_description")}/urdf/humanoid.urdf.xacro'
    assert main([file, 'scale:=0.5', 'prefix:=r1_', 'sclae:=1']) == 0
    captured = capsys.readouterr()
    assert '5.350 kg' in captured.out
    assert captured.out.endswith(f'The xacro output of {file} is sound: 19 checks passed.\n')
    assert 'sclae' in captured.err


@pytest.mark.parametrize(
    ('arguments', 'sentence'),
    [
        (['--scale', '3'], 'The scale 3 is out of range. Give one from 0.5 to 1.3.'),
        (['nowhere.urdf'], 'nowhere.urdf cannot be read: No such file or directory.'),
        (['nowhere.xacro'], 'nowhere.xacro cannot be read: No such file or directory.'),
        (['scale:=0.5'], "'scale:=0.5' is an argument of a xacro file: name the file before it."),
        (['robot.xacro', 'other.xacro'], "'other.xacro' is not a xacro argument"),
        (['robot.urdf', 'scale:=1'], "robot.urdf is not a xacro file; it cannot take 'scale:=1'."),
        (['robot.urdf', '--scale', '1'], 'robot.urdf is checked as it is. Leave out --scale'),
    ],
)
def test_nothing_to_check(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without a model there is one sentence and status 1."""
    assert main(arguments) == 1
    assert capsys.readouterr().err.startswith(sentence)


@pytest.mark.parametrize(
    ('content', 'reason'),
    [
        ('<robot name="a" xmlns:xacro="x">\n<link></robot>', 'mismatched tag'),
        (
            '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">${b}</robot>',
            "name 'b' is not defined",
        ),
        (
            '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m">'
            '<xacro:m/></xacro:macro><xacro:m/></robot>',
            'infinite recursion of macros or includes',
        ),
    ],
)
def test_broken_xacro(
    content: str, reason: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What xacro cannot expand is told in its words, which name the file."""
    path = tmp_path / 'broken.xacro'
    path.write_text(content)
    assert main([str(path)]) == 1
    first, *said = capsys.readouterr().err.splitlines()
    assert first == f'xacro cannot expand {path}:'
    assert reason in said[0]
    assert 'Traceback' not in ''.join(said)


def test_file_that_includes_itself(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A circle of files is told with each of them."""
    one, two = tmp_path / 'one.xacro', tmp_path / 'two.xacro'
    text = (
        '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include {}/></robot>'
    )
    one.write_text(text.format('filename="two.xacro"'))
    two.write_text(text.format('filename="one.xacro"'))
    assert main([str(one)]) == 1
    error = capsys.readouterr().err
    assert 'infinite recursion of macros or includes' in error
    assert str(one) in error and str(two) in error


def test_text_that_is_not_in_utf_8(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever the machine's language is, models are read as UTF-8."""
    path = tmp_path / 'latin.urdf'
    path.write_bytes('<robot name="Bär"/>'.encode('latin-1'))
    assert main([str(path)]) == 1
    assert capsys.readouterr().err == f'{path} is not valid UTF-8 text.\n'


def test_long_chain_of_frames() -> None:
    """Thousands of fixed links below a moving one are no obstacle; none has a mass."""
    parts = ['<link name="l0"/>', *(f'<link name="l{i}"/>' for i in range(1, 1500))]
    for i in range(1, 1500):
        kind = 'fixed' if i > 1 else 'continuous'
        ends = f'<parent link="l{i - 1}"/><child link="l{i}"/>'
        parts.append(f'<joint name="j{i}" type="{kind}">{ends}</joint>')
    outcomes = check_robot(load_robot(f'<robot name="r">{"".join(parts)}</robot>', 'chain.urdf'))
    defects = [defect for outcome in outcomes for defect in outcome.defects]
    start = "line 1: Link 'l1' is moved by joint 'j1', but neither"
    assert len(defects) == 1 and defects[0].startswith(start)


@pytest.mark.parametrize(
    ('redirection', 'status', 'errors'),
    [
        ('>/dev/full', 1, 'The result cannot be written: No space left on device.\n'),
        ('| true', 141, ''),
        ('>&-', 0, ''),
    ],
)
def test_output_that_nobody_gets(redirection: str, status: int, errors: str) -> None:
    """A full disk is named; a reader that is gone is none of our business."""
    command = f'"$0" -m humanoid_description.check_model {redirection}; exit "${{PIPESTATUS[0]}}"'
    words = ['bash', '-c', command, sys.executable]
    result = subprocess.run(words, stderr=subprocess.PIPE, text=True, check=False)
    assert (result.returncode, result.stderr) == (status, errors)


def test_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C ends the program without a word."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr('humanoid_description.expansion.humanoid_urdf', interrupt)
    assert main([]) == 130
