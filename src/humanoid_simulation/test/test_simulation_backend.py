# SPDX-License-Identifier: Apache-2.0
"""The simulated world keeps the promises of a backend."""

from __future__ import annotations

from humanoid_control.backends import Backend, JointTargets
from humanoid_simulation.backend import BackendSettings, EntityState, MujocoBackend
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.keyframes import Keyframe
from humanoid_simulation.model import Placement
import numpy as np
import pytest

LEVEL = np.array([1.0, 0.0, 0.0, 0.0])

GRAVITY = 9.81
MASS = 42.8


def run(backend: MujocoBackend, seconds: float) -> None:
    """Let time pass without new targets."""
    for _ in range(round(seconds / backend.period_s)):
        backend.step({})


def test_it_is_a_backend(backend: MujocoBackend) -> None:
    """Names, period and time are those of the interface."""
    checked: Backend = backend
    assert checked.robots == ('',)
    assert len(checked.joints) == 23
    assert checked.period_s == pytest.approx(0.01)
    assert checked.observe()[''].time_s == 0.0
    backend.step({})
    assert checked.observe()[''].time_s == pytest.approx(0.01)


def test_it_stands_at_home_with_plain_servos(backend: MujocoBackend) -> None:
    """Ten seconds in the posture that begins all walks: upright, at rest, on both feet."""
    run(backend, 10.0)
    truth, seen = backend.ground_truth(), backend.observe()['']
    assert truth.position_m[2] > 0.68
    assert abs(truth.orientation[0]) > 0.999
    assert np.abs(truth.linear_velocity_m_s).max() < 1e-3
    assert seen.foot_forces_n[:, 2].sum() == pytest.approx(MASS * GRAVITY, rel=1e-3)
    assert np.linalg.norm(seen.linear_acceleration_m_s2) == pytest.approx(GRAVITY, abs=0.01)
    assert np.abs(seen.positions_rad - backend_home(backend)).max() < 0.06


def backend_home(backend: MujocoBackend) -> np.ndarray:
    """Return the positions of the joints at home."""
    backend.reset()
    return backend.observe()[''].positions_rad


@pytest.mark.parametrize('scale', [0.65])
def test_a_smaller_robot_stands_as_well(scale: float, keyframes) -> None:
    """The posture is one of angles: it serves a robot of any size."""
    from humanoid_simulation.model import humanoid

    backend = MujocoBackend(humanoid(scale), keyframes=keyframes)
    run(backend, 3.0)
    assert backend.ground_truth().position_m[2] > 0.68 * scale


def test_the_sole_wrench_is_where_the_ground_pushes(backend: MujocoBackend) -> None:
    """The centre of pressure of the wrenches lies below the centre of mass, at rest."""
    run(backend, 5.0)
    seen = backend.observe()['']
    forces, torques = seen.foot_forces_n, seen.foot_torques_nm
    centre_x = -torques[0, 1] / forces[0, 2]
    contacts = [c for c in backend.contacts() if 'left_foot' in (c.body1, c.body2)]
    weights = np.array([c.force_n[2] for c in contacts])
    from_contacts = weights @ np.array([c.position_m[0] for c in contacts]) / weights.sum()
    sole = backend._data.body('robot/l_sole').xpos[0]
    assert centre_x == pytest.approx(from_contacts - sole, abs=2e-3)
    assert weights.sum() == pytest.approx(forces[0, 2], rel=1e-3)


def test_a_drive_exerts_what_the_interface_says(backend: MujocoBackend, hold) -> None:
    """Kp (position - q) + kd (velocity - dq) + effort, within the limits of the drive."""
    run(backend, 2.0)
    seen = backend.observe()['']
    elbow = backend.joints.index('left_elbow')
    targets = hold(seen.positions_rad)
    targets.efforts_nm[elbow] = 2.0
    targets.velocities_rad_s[elbow] = 0.5
    backend._robots[''].command(targets)
    servo = backend._model.actuator('robot/left_elbow')
    ctrl = backend._data.ctrl[servo.id]
    torque = servo.gainprm[0] * (ctrl - seen.positions_rad[elbow])
    assert torque == pytest.approx(2.0 + 1.5 * 0.5)


def test_a_target_that_jumps_is_followed_within_the_limits(backend: MujocoBackend, hold) -> None:
    """Neither position, velocity nor effort leave what the drives can do."""
    head = backend.joints.index('head_yaw')
    targets = hold(backend.observe()[''].positions_rad)
    targets.positions_rad[head] = 100.0
    targets.velocities_rad_s[head] = 1e6
    targets.efforts_nm[head] = -1e6
    fastest = 0.0
    for _ in range(300):
        backend.step({'': targets})
        seen = backend.observe()['']
        fastest = max(fastest, abs(seen.velocities_rad_s[head]))
        assert abs(seen.efforts_nm[head]) <= 8.0 + 1e-9
    assert seen.positions_rad[head] < 1.4 + 0.05
    assert fastest < 20.0


def test_observations_do_not_change_afterwards(backend: MujocoBackend) -> None:
    """Who keeps an observation keeps what was seen then."""
    before = backend.observe()['']
    copy = before.positions_rad.copy()
    backend.apply_wrench('torso', (100.0, 0.0, 0.0))
    run(backend, 0.1)
    assert (before.positions_rad == copy).all()
    assert not (backend.observe()[''].positions_rad == copy).all()


def test_targets_go_on_for_a_while_when_told_so(make_backend, hold) -> None:
    """With extrapolation, a missed tick moves the target on with its velocity, not for ever."""
    moved = {}
    for extrapolation_s in (0.0, 0.05):
        backend = make_backend(settings=BackendSettings(extrapolation_s=extrapolation_s))
        head = backend.joints.index('head_yaw')
        targets = hold(backend.observe()[''].positions_rad)
        targets.velocities_rad_s[head] = 2.0
        backend.step({'': targets})
        run(backend, 1.0)
        moved[extrapolation_s] = backend.observe()[''].positions_rad[head]
    assert moved[0.05] == pytest.approx(0.1, abs=0.02)
    assert moved[0.05] > moved[0.0]


@pytest.mark.parametrize('kind', ['positions_rad', 'velocities_rad_s', 'efforts_nm'])
@pytest.mark.parametrize('value', [float('nan'), float('inf'), -float('inf')])
def test_targets_that_are_not_finite_are_refused(backend, hold, kind: str, value: float) -> None:
    """The error names the joint, no time passes, and nothing is moved."""
    targets = hold(backend.observe()[''].positions_rad.copy())
    getattr(targets, kind)[backend.joints.index('left_knee')] = value
    with pytest.raises(SimulationError, match='not finite, of left_knee'):
        backend.step({'': targets})
    assert backend.time_s == 0.0
    run(backend, 1.0)
    assert backend.ground_truth().position_m[2] > 0.68


def test_targets_of_the_wrong_number_are_refused(backend: MujocoBackend) -> None:
    """The error says how many joints there are."""
    with pytest.raises(SimulationError, match='has 23 joints'):
        backend.step({'': JointTargets(np.zeros(22), np.zeros(23), np.zeros(23))})


def test_targets_of_an_unknown_robot_are_refused(make_backend, hold) -> None:
    """The error names the robot that was meant."""
    backend = make_backend(placements=[Placement('robot1')])
    with pytest.raises(SimulationError, match="Did you mean 'robot1'"):
        backend.step({'robot2': hold(np.zeros(23))})


def test_the_same_seed_gives_the_same_trajectory(make_backend, hold) -> None:
    """Two runs agree bit for bit, with noise and with pushes."""
    from humanoid_simulation.backend.noise import REALISTIC

    def trajectory(seed: int) -> list[bytes]:
        backend = make_backend(settings=BackendSettings(noise=REALISTIC, seed=seed))
        states = []
        for tick in range(100):
            if tick == 20:
                backend.apply_wrench('torso', (30.0, 10.0, 0.0))
            # What is seen is used, so that noise changes the motion.
            backend.step({'': hold(backend.observe()[''].positions_rad)})
            states.append(backend.snapshot().qpos.tobytes())
        return states

    assert trajectory(1) == trajectory(1)
    assert trajectory(1) != trajectory(2)


def test_observations_may_be_old(make_backend) -> None:
    """With a latency of two periods one sees what was true two periods ago."""
    backend = make_backend(settings=BackendSettings(latency_periods=2))
    times = []
    for _ in range(5):
        times.append(backend.observe()[''].time_s)
        backend.step({})
    assert times == pytest.approx([0.0, 0.0, 0.0, 0.01, 0.02])


def test_a_reset_puts_all_back_and_time_goes_on(backend: MujocoBackend) -> None:
    """After a push the robot is where it began, at rest; the clock has not jumped back."""
    start = backend.snapshot().qpos
    backend.apply_wrench('torso', (500.0, 0.0, 0.0), duration_s=5.0)
    run(backend, 1.0)
    time_s = backend.time_s
    backend.reset()
    assert (backend.snapshot().qpos == start).all()
    assert not backend.snapshot().qvel.any()
    assert backend.time_s == time_s == backend.observe()[''].time_s
    run(backend, 1.0)
    assert backend.ground_truth().position_m[2] > 0.68


@pytest.mark.parametrize(
    ('keyframe', 'height_m', 'up'),
    [('stretched', 0.73, 2), ('crouched', 0.57, 2), ('lying_on_back', 0.1, 0)],
)
def test_a_reset_to_a_posture(backend, keyframe: str, height_m: float, up: int) -> None:
    """Each keyframe is taken with the lowest point on the ground; nothing bursts apart."""
    backend.reset(keyframe)
    assert backend.ground_truth().position_m[2] == pytest.approx(height_m, abs=0.06)
    lowest = min(contact.position_m[2] for contact in backend.contacts())
    assert lowest == pytest.approx(0.0, abs=2e-3)
    run(backend, 0.5)
    assert np.abs(backend.snapshot().qvel).max() < 10.0
    acceleration = backend.observe()[''].linear_acceleration_m_s2
    if up == 0:
        assert acceleration[0] > 9.0


def test_an_unknown_keyframe_is_refused(backend: MujocoBackend) -> None:
    """The error names the one that was meant, and nothing is reset."""
    run(backend, 0.1)
    before = backend.snapshot().qpos
    with pytest.raises(SimulationError, match="no keyframe 'hom'. Did you mean 'home'"):
        backend.reset('hom')
    assert (backend.snapshot().qpos == before).all()


def test_a_keyframe_of_ones_own(description) -> None:
    """Postures can be given, and one with an unknown joint is refused."""
    frames = {'home': Keyframe({'left_elbow': -1.0})}
    backend = MujocoBackend(description, keyframes=frames)
    assert backend.observe()[''].positions_rad[backend.joints.index('left_elbow')] == -1.0
    with pytest.raises(SimulationError, match="Did you mean 'left_elbow'"):
        MujocoBackend(description, keyframes={'home': Keyframe({'left_elbo': -1.0})})


@pytest.mark.parametrize('force_n', [1e14, 1e300])
def test_physics_that_explodes_says_so(
    backend: MujocoBackend, force_n: float, tmp_path, monkeypatch
) -> None:
    """Numbers without bounds become an error; the last sound state stays, and a reset helps."""
    monkeypatch.chdir(tmp_path)
    backend.apply_wrench('torso', (force_n, 0.0, 0.0))
    with pytest.raises(SimulationError, match=r'unstable at .* Reset the simulation'):
        run(backend, 1.0)
    assert np.isfinite(backend.ground_truth().position_m).all()
    assert np.isfinite(backend.observe()[''].positions_rad).all()
    backend.reset()
    run(backend, 1.0)
    assert backend.ground_truth().position_m[2] > 0.68
    assert not list(tmp_path.iterdir()), 'MuJoCo wrote a log file'


def test_two_robots_in_one_world(make_backend, hold) -> None:
    """Each is seen and moved by its name, begins at its place, and is alike the other one."""
    places = [Placement('robot1'), Placement('robot2', y_m=1.0, yaw_rad=np.pi / 2)]
    backend = make_backend(placements=places)
    assert backend.robots == ('robot1', 'robot2')
    head = backend.joints.index('head_yaw')
    targets = hold(backend.observe()['robot2'].positions_rad.copy())
    targets.positions_rad[head] = 0.5
    for _ in range(100):
        backend.step({'robot2': targets})
    seen = backend.observe()
    assert seen['robot1'].positions_rad[head] == pytest.approx(0.0, abs=0.01)
    assert seen['robot2'].positions_rad[head] == pytest.approx(0.5, abs=0.05)
    truth = backend.ground_truth('robot2')
    assert truth.position_m[:2] == pytest.approx([0.0, 1.0], abs=0.05)
    assert truth.orientation == pytest.approx([np.sqrt(0.5), 0, 0, np.sqrt(0.5)], abs=0.05)
    bodies = {contact.body2 for contact in backend.contacts()}
    assert bodies == {f'robot{n}/{side}_foot' for n in (1, 2) for side in ('left', 'right')}


@pytest.mark.parametrize(
    'options',
    [{'steps_per_period': 0}, {'latency_periods': -1}, {'extrapolation_s': float('nan')}],
)
def test_settings_that_cannot_be(options) -> None:
    """The error says what to give."""
    with pytest.raises(SimulationError, match='Give'):
        BackendSettings(**options)


@pytest.mark.parametrize(
    'state',
    [
        EntityState(np.array([1e9, 0.0, 1.0]), LEVEL),
        EntityState(np.zeros(3), LEVEL, np.array([0.0, -1e300, 0.0])),
        EntityState(np.zeros(3), LEVEL, np.zeros(3), np.array([0.0, 0.0, 1e5])),
    ],
)
def test_places_that_cannot_be_computed_with(backend: MujocoBackend, state: EntityState) -> None:
    """A state beyond all bounds is refused, and nothing moves."""
    before_m = backend.ground_truth().position_m
    with pytest.raises(SimulationError, match='is out of range'):
        backend.set_entity_state('robot', state)
    assert backend.ground_truth().position_m == pytest.approx(before_m)


def test_wrenches_without_end(backend: MujocoBackend) -> None:
    """Too many at a time are refused, but not that of the hoist; a reset ends all of them."""
    for _ in range(100):
        backend.apply_wrench('torso', (0.1, 0.0, 0.0), duration_s=1e9)
    with pytest.raises(SimulationError, match='100 wrenches are already active'):
        backend.apply_wrench('torso', (0.1, 0.0, 0.0))
    backend.hoist()
    run(backend, 0.1)
    assert backend.is_hoisted()
    backend.reset()
    backend.apply_wrench('torso', (0.1, 0.0, 0.0))
