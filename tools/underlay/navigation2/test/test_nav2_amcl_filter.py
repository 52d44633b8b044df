# SPDX-License-Identifier: Apache-2.0
"""The localizer follows a simulated robot in a flat: odometry drifts, people stand in the way."""

from __future__ import annotations

from dataclasses import replace
import math
from pathlib import Path
import sys

from nav2_amcl.clusters import best_cluster, find_clusters
from nav2_amcl.laser_models import BeamSkipping, LASER_MODELS, LaserNoise, make_laser_model
from nav2_amcl.localizer import Localizer, LocalizerSettings
from nav2_amcl.missing import describe_missing, Inputs, Reminder
from nav2_amcl.motion_models import MOTION_MODELS, MotionNoise
from nav2_amcl.occupancy_map import FREE, OccupancyMap, OCCUPIED, RayCaster, UNKNOWN
from nav2_amcl.particle_filter import FilterOptions, ParticleFilter
from nav2_amcl.resampling import draw_systematically, kld_size, needed_size
from nav2_amcl.scan_projection import Beams, project_scan, Scan
from nav2_util.geometry import Pose2D
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))  # tests are imported by their files
from amcl_flat import (  # noqa: E402, I100
    ANGLES,
    CASTER,
    FAR_M,
    FLAT,
    follow,
    laser_at,
    make_localizer,
    START,
    Walker,
)


@pytest.mark.parametrize('motion', sorted(MOTION_MODELS))
def test_tracks_a_minute(motion):
    """While it walks, the error stays below 0.15 m and 5 degrees; see `story_nav2_amcl.py`."""
    localizer, walker = make_localizer(motion_model=motion), Walker(1)
    localizer.start_at(START)
    errors = follow(localizer, walker, 60.0)
    assert errors[5:, 0].max() < 0.15
    assert errors[5:, 1].max() < 5.0


@pytest.mark.parametrize('laser', LASER_MODELS)
def test_recovers_from_one_metre_off(laser):
    """An initial pose one metre off is corrected after some metres."""
    localizer, walker = make_localizer(laser_model=laser), Walker(2)
    localizer.start_at(START @ Pose2D(0.7, 0.7, 0.15))
    errors = follow(localizer, walker, 40.0)
    assert errors[-10:, 0].max() < 0.15
    assert errors[-10:, 1].max() < 5.0


@pytest.mark.parametrize('seed', range(2))
@pytest.mark.parametrize('laser', ['likelihood_field', 'likelihood_field_prob'])
def test_finds_itself_anywhere(seed, laser):
    """Global localisation converges after some metres."""
    localizer, walker = make_localizer(seed, laser_model=laser), Walker(seed)
    localizer.start_anywhere()
    errors = follow(localizer, walker, 45.0)
    assert errors[-5:, 0].max() < 0.2
    assert localizer.estimate.weight > 0.9


def test_recovers_when_carried_away():
    """With recovery on, a robot that was carried to another room finds itself again."""
    options = FilterOptions(alpha_slow=0.02, alpha_fast=0.3)
    localizer, walker = make_localizer(filter_options=options), Walker(3)
    localizer.start_at(START)
    assert follow(localizer, walker, 20.0)[-1, 0] < 0.2
    walker.pose, walker.next = Pose2D(4.0, 8.0, 2.0), 6
    assert follow(localizer, walker, 50.0)[-5:, 0].max() < 0.2


def test_beam_skipping_ignores_a_crowd():
    """Beams that a crowd hides are skipped, so that the rest tells the pose."""
    noise, truth = LaserNoise(), np.array([START])
    ranges = CASTER.cast(truth[:, :2], ANGLES, FAR_M)
    ranges[:150] = 0.6
    scan = Scan(ranges, -math.pi, math.radians(1.0), 0.1, FAR_M)
    beams = project_scan(scan, np.eye(3), np.zeros(3), 60)
    model = make_laser_model('likelihood_field_prob', FLAT, noise, BeamSkipping())
    plain = make_laser_model('likelihood_field_prob', FLAT, noise)
    assert model.log_likelihoods(truth, beams)[0] > plain.log_likelihoods(truth, beams)[0] + 10.0


def test_updates_only_after_motion():
    """A robot that stands updates once, and again when forced or after update_min_d."""
    localizer, walker = make_localizer(), Walker(4)
    localizer.start_at(START)
    scan, odom = walker.scan(), walker.odom

    def observe(moved):
        return localizer.observe(scan, *laser_at(moved), moved)

    assert observe(odom)
    assert not observe(odom)
    localizer.force_update()
    assert observe(odom)
    assert not observe(odom @ Pose2D(0.2, 0.0, 0.1))
    assert observe(odom @ Pose2D(0.26, 0.0, 0.0))
    assert observe(odom @ Pose2D(0.26, 0.0, 0.25))


def test_waits_for_map_and_start():
    """Without a map or a start, scans are ignored."""
    walker = Walker(0)
    localizer = Localizer(LocalizerSettings(), np.random.default_rng(0))
    localizer.start_at(START)
    assert not localizer.observe(walker.scan(), *laser_at(walker.odom), walker.odom)
    localizer = make_localizer()
    assert not localizer.observe(walker.scan(), *laser_at(walker.odom), walker.odom)


@pytest.mark.parametrize('laser', LASER_MODELS)
@pytest.mark.parametrize('value', [math.inf, math.nan, FAR_M, 0.0, -1.0, -math.inf])
def test_scan_without_returns(laser, value):
    """Ranges without returns, or that are no numbers, leave a pose that is finite."""
    localizer = make_localizer(laser_model=laser)
    localizer.start_at(START)
    scan = Scan(np.full(360, value), -math.pi, math.radians(1.0), 0.1, FAR_M)
    assert localizer.observe(scan, np.eye(3), np.zeros(3), Pose2D(0.0, 0.0, 0.0))
    assert np.isfinite(localizer.estimate.pose).all()
    assert np.isfinite(localizer.filter.weights).all()


@pytest.mark.parametrize('laser', LASER_MODELS)
def test_empty_scan(laser):
    """A scan without ranges changes nothing."""
    localizer = make_localizer(laser_model=laser)
    localizer.start_at(START)
    scan = Scan(np.zeros(0), 0.0, 0.01, 0.1, FAR_M)
    assert localizer.observe(scan, np.eye(3), np.zeros(3), Pose2D(0.0, 0.0, 0.0))
    assert localizer.estimate.pose == pytest.approx(START, abs=0.2)


@pytest.mark.parametrize('laser', LASER_MODELS)
@pytest.mark.parametrize('value', [FREE, OCCUPIED, UNKNOWN])
def test_map_of_one_kind_of_cells(laser, value):
    """Maps that are all free, occupied or unknown fail nowhere."""
    localizer = make_localizer(laser_model=laser)
    localizer.set_map(OccupancyMap(np.full((40, 30), value, np.int8), 0.1))
    localizer.start_anywhere()
    for _ in range(3):
        localizer.force_update()
        scan = Walker(0).scan()
        assert localizer.observe(scan, np.eye(3), np.zeros(3), Pose2D(0.0, 0.0, 0.0))
        assert np.isfinite(localizer.estimate.pose).all()


@pytest.mark.parametrize('laser', LASER_MODELS)
def test_likelihood_is_highest_at_the_truth(laser):
    """A scan is likelier where it was taken than 0.3 m or 15 degrees away."""
    truth = np.array([0.0, 4.5, 0.4])
    ranges = CASTER.cast(truth[None, :2], truth[2] + ANGLES, FAR_M)
    scan = Scan(ranges, -math.pi, math.radians(1.0), 0.1, FAR_M)
    beams = project_scan(scan, np.eye(3), np.zeros(3), 60)
    off = [[0.3, 0, 0], [-0.3, 0, 0], [0, 0.3, 0], [0, -0.3, 0], [0, 0, 0.26], [0, 0, -0.26]]
    particles = truth + np.array([[0.0, 0.0, 0.0], *off])
    model = make_laser_model(laser, FLAT, LaserNoise())
    assert np.argmax(model.log_likelihoods(particles, beams)) == 0


def test_laser_ahead_of_the_base():
    """A laser that is mounted ahead and turned is taken into account."""
    truth, mount = START, Pose2D(0.2, 0.05, math.pi / 2.0)
    laser = truth @ mount
    ranges = CASTER.cast(np.array([[laser.x, laser.y]]), laser.yaw + ANGLES, FAR_M)
    localizer, odom = make_localizer(), Pose2D(3.0, 1.0, -1.0)
    localizer.start_at(truth @ Pose2D(0.1, 0.1, 0.1))
    for _ in range(5):
        localizer.force_update()
        localizer.observe(
            Scan(ranges, -math.pi, math.radians(1.0), 0.1, FAR_M),
            *laser_at(odom @ mount),
            odom,
        )
    assert localizer.estimate.pose == pytest.approx(truth, abs=0.06)


def test_tilted_laser_is_projected():
    """A beam of a laser that is pitched by 20 degrees is shorter in the plane."""
    pitch = math.radians(20.0)
    rotation = np.array(
        [
            [math.cos(pitch), 0.0, math.sin(pitch)],
            [0.0, 1.0, 0.0],
            [-math.sin(pitch), 0.0, math.cos(pitch)],
        ]
    )
    scan = Scan(np.array([2.0, 2.0]), 0.0, math.pi / 2.0, 0.1, FAR_M)
    points = project_scan(scan, rotation, np.array([0.1, 0.0, 1.0]), 60).points()
    assert points[0] == pytest.approx([0.1 + 2.0 * math.cos(pitch), 0.0])
    assert points[1] == pytest.approx([0.1, 2.0])


def test_chooses_beams_among_usable_ones():
    """Beams that are no numbers or too near do not count; the others are spread evenly."""
    ranges = np.full(360, 3.0)
    ranges[::2], ranges[1::4] = np.nan, 0.01
    beams = project_scan(
        Scan(ranges, -math.pi, math.radians(1.0), 0.1, FAR_M), np.eye(3), np.zeros(3), 30
    )
    assert len(beams.ranges) == 30
    assert beams.hits.all()
    assert np.ptp(beams.angles) > 6.0


def test_limits_of_ranges():
    """laser_min_range and laser_max_range replace the scanner's limits, within them."""
    scan = Scan(np.array([0.3, 2.0, 5.0, 20.0]), 0.0, 0.1, 0.1, FAR_M)
    beams = project_scan(scan, np.eye(3), np.zeros(3), 60, 0.5, 4.0)
    assert beams.ranges.tolist() == pytest.approx([2.0, 4.0, 4.0])
    assert beams.hits.tolist() == [True, False, False]
    assert project_scan(scan, np.eye(3), np.zeros(3), 60, -1.0, 100.0).max_range_m == FAR_M


@pytest.mark.parametrize('yaw', [0.0, 0.7])
def test_rays_end_at_walls(yaw):
    """Rays are as long as the walls are away, also in a map whose origin is turned."""
    cells = np.zeros((60, 100), np.int8)
    cells[:, 80] = OCCUPIED
    grid = OccupancyMap(cells, 0.1, (1.0, 2.0, yaw))
    start = grid.to_map(np.array([[20.5, 30.5]]))
    angles = yaw + np.array([0.0, 0.3, -0.3, math.pi, math.pi / 2.0])
    found = RayCaster(grid).cast(start, angles, 30.0)
    exact = 5.95 / np.cos([0.0, 0.3, -0.3])
    assert found[:3] == pytest.approx(exact, abs=0.1)
    assert np.isinf(found[3:]).all()
    assert np.isinf(RayCaster(grid).cast(start, angles, 5.0)).all()


def test_rays_agree_with_small_steps():
    """Sphere tracing finds what small steps find."""
    random = np.random.default_rng(0)
    poses = FLAT.sample_free_poses(300, random)
    found = CASTER.cast(poses[:, :2], poses[:, 2], FAR_M)
    lengths = np.arange(0.0, FAR_M, 0.005)
    directions = np.stack((np.cos(poses[:, 2]), np.sin(poses[:, 2])), axis=-1)
    points = poses[:, None, :2] + lengths[:, None] * directions[:, None, :]
    cells = np.floor(FLAT.to_grid(points)).astype(int)
    occupied = FLAT.cells[cells[..., 1].clip(0, 199), cells[..., 0].clip(0, 219)] == OCCUPIED
    exact = lengths[occupied.argmax(axis=1)]
    assert np.quantile(np.abs(found - exact), 0.97) < 0.06


def test_distances():
    """The distance of a cell to an obstacle is that of their centres."""
    cells = np.zeros((5, 7), np.int8)
    cells[2, 1] = OCCUPIED
    distances = OccupancyMap(cells, 0.5).distances
    assert distances[2, 1] == 0.0
    assert distances[2, 5] == pytest.approx(2.0)
    assert distances[4, 3] == pytest.approx(math.sqrt(2.0))


def test_free_poses_are_free():
    """Poses anywhere are in free cells only."""
    poses = FLAT.sample_free_poses(500, np.random.default_rng(0), every=4)
    cells = np.floor(FLAT.to_grid(poses[:, :2])).astype(int)
    assert (FLAT.cells[cells[:, 1], cells[:, 0]] == FREE).all()


@pytest.mark.parametrize('model', MOTION_MODELS.values())
def test_motion_follows_odometry(model):
    """Without noise, particles move as odometry does in their own frames."""
    before, after = Pose2D(1.0, 2.0, 0.5), Pose2D(1.0, 2.0, 0.5) @ Pose2D(0.4, 0.1, 0.3)
    silent = MotionNoise(0.0, 0.0, 0.0, 0.0, 0.0)
    moved = model.move(
        np.array([[0.0, 0.0, 0.0], [1.0, 1.0, math.pi / 2.0]]),
        before,
        after,
        silent,
        np.random.default_rng(0),
    )
    assert moved[0] == pytest.approx([0.4, 0.1, 0.3])
    assert moved[1] == pytest.approx([0.9, 1.4, math.pi / 2.0 + 0.3])


@pytest.mark.parametrize('model', MOTION_MODELS.values())
def test_motion_noise_grows(model):
    """Particles spread with the motion, and not at all without one."""
    particles, random = np.zeros((4000, 3)), np.random.default_rng(0)
    still = Pose2D(0.0, 0.0, 0.0)
    assert not model.move(particles, still, still, MotionNoise(), random).any()
    moved = model.move(particles, still, Pose2D(0.5, 0.0, 0.0), MotionNoise(), random)
    assert moved[:, 0].mean() == pytest.approx(0.5, abs=0.03)
    assert moved[:, 0].std() == pytest.approx(0.5 * math.sqrt(0.2), rel=0.15)
    backward = model.move(particles, still, Pose2D(-0.5, 0.0, 0.0), MotionNoise(), random)
    assert backward[:, 2].std() == pytest.approx(moved[:, 2].std(), rel=0.1)


def test_kld_sizes():
    """More bins need more particles, as in Fox's paper."""
    sizes = kld_size(np.array([1, 2, 10, 100]), 0.05, 0.99)
    assert sizes[0] == 1.0
    # Of a chi-squared distribution: its quantile over twice the error.
    assert sizes[2] == pytest.approx(21.666 / 0.1, rel=0.02)
    assert sizes[3] == pytest.approx(134.64 / 0.1, rel=0.02)
    assert (kld_size(np.array([2, 10, 100]), 0.1, 0.99) < sizes[1:]).all()


def test_sizes_follow_the_spread():
    """Few particles are kept when they agree, many when they are everywhere, within limits."""
    random = np.random.default_rng(0)
    anywhere = FLAT.sample_free_poses(2000, random)
    together = random.normal(0.0, 0.02, (2000, 3)) + [0.25, 0.25, 0.1]
    weights = np.full(2000, 1.0 / 2000)
    assert needed_size(together, weights, (100, 2000), 0.05, 0.99, random) <= 150
    assert needed_size(anywhere, weights, (100, 2000), 0.05, 0.99, random) == 2000
    assert needed_size(anywhere, weights, (50, 60), 0.05, 0.99, random) == 60
    assert needed_size(together, weights, (7, 7), 0.05, 0.99, random) == 7


def test_draws_by_weight():
    """Each index is drawn as often as its weight says, give or take one."""
    weights = np.array([0.5, 0.25, 0.125, 0.125, 0.0])
    drawn = draw_systematically(weights, 80, np.random.default_rng(0))
    assert np.bincount(drawn, minlength=5) == pytest.approx([40, 20, 10, 10, 0], abs=1)


def test_clusters():
    """Particles far apart are different clusters; headings near ±180 degrees belong together."""
    random = np.random.default_rng(0)
    one = random.normal(0.0, 0.05, (300, 3)) + [1.0, 1.0, math.pi]
    other = random.normal(0.0, 0.05, (100, 3)) + [4.0, 1.0, 0.0]
    particles = np.concatenate((one, other))
    labels = find_clusters(particles)
    assert len(set(labels[:300])) == 1
    assert len(set(labels)) == 2
    best = best_cluster(particles, np.full(400, 1.0 / 400))
    assert best.weight == pytest.approx(0.75)
    assert best.pose[:2] == pytest.approx([1.0, 1.0], abs=0.02)
    assert abs(best.pose[2]) == pytest.approx(math.pi, abs=0.02)
    assert np.diag(best.covariance) == pytest.approx([0.0025] * 3, rel=0.3)


def test_start_has_the_covariance():
    """Particles are drawn with the covariance that was given."""
    made = ParticleFilter(FilterOptions(), np.random.default_rng(0))
    covariance = np.array([[0.2, 0.1, 0.0], [0.1, 0.3, 0.0], [0.0, 0.0, 0.05]])
    made.start_at((1.0, 2.0, 0.3), covariance)
    assert np.cov(made.particles.T) == pytest.approx(covariance, abs=0.03)
    assert made.particles.mean(axis=0) == pytest.approx([1.0, 2.0, 0.3], abs=0.05)


def test_same_seed_same_pose():
    """Runs with the same seed and inputs end the same."""
    ends = []
    for _ in range(2):
        localizer, walker = make_localizer(7), Walker(7)
        localizer.start_at(START)
        follow(localizer, walker, 10.0)
        ends.append(localizer.estimate.pose)
    assert ends[0] == ends[1]


def test_settings_change_while_it_works():
    """Another model and other sizes hold from the next update on."""
    localizer, walker = make_localizer(), Walker(5)
    localizer.start_at(START)
    follow(localizer, walker, 5.0)
    options = FilterOptions(min_particles=60, max_particles=100)
    localizer.use(replace(LocalizerSettings(), laser_model='beam', filter_options=options))
    errors = follow(localizer, walker, 10.0)
    assert len(localizer.filter.particles) <= 100
    assert errors[-1, 0] < 0.3


def test_beams_without_hits_have_no_points():
    """Only hits are points."""
    beams = Beams((0.0, 0.0), np.zeros(2), np.array([1.0, 9.0]), np.array([True, False]), 9.0)
    assert beams.points().tolist() == [[1.0, 0.0]]


def test_missing_inputs_are_named():
    """What is missing is said with what to do."""
    nothing = Inputs(False, False, 9.0, '', '/map', '/scan')
    texts = describe_missing(nothing)
    assert [word in text for word, text in zip(("'/map'", 'RViz', "'/scan'"), texts)] == [True] * 3
    waiting = Inputs(True, True, 0.1, "'odom' is unknown", '/map', '/scan')
    assert 'odom_frame_id' in describe_missing(waiting)[0]
    assert not describe_missing(Inputs(True, True, 0.1, '', '/map', '/scan'))


def test_reminder_repeats_seldom():
    """The same is said at the second look and half a minute later, what is new at its own."""
    reminder = Reminder()
    assert not reminder.text_for(['No map.'], 0.0)
    assert reminder.text_for(['No map.'], 2.0) == 'No map.'
    assert not reminder.text_for(['No map.', 'No scan.'], 4.0)
    assert reminder.text_for(['No map.', 'No scan.'], 6.0) == 'No scan.'
    assert reminder.text_for(['No map.', 'No scan.'], 33.0) == 'No map.'
    assert not reminder.text_for([], 40.0)
