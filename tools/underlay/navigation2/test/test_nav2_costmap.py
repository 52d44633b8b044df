# SPDX-License-Identifier: Apache-2.0
"""The pure core of costmaps: grids, footprints, rays, inflation and layers."""

from __future__ import annotations

import math

from geometry_msgs.msg import Transform
from nav2_costmap_2d.costmap_messages import costmap_from, make_costmap_message, make_grid
from nav2_costmap_2d.costs import (
    cost_table,
    FREE_SPACE,
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
    occupancy_of,
)
from nav2_costmap_2d.denoise_layer import remove_small_groups
from nav2_costmap_2d.footprint import (
    Footprint,
    FootprintCollisionChecker,
    is_collision,
    pad,
    parse_footprint,
    radii_of,
)
from nav2_costmap_2d.grid import Costmap2D
from nav2_costmap_2d.inflation_layer import Inflation
from nav2_costmap_2d.layers import Layer, LayeredCostmap
from nav2_costmap_2d.raytracing import clear_rays, mark_points, Observation
from nav2_costmap_2d.regions import forget_cells, Region, write_maximum, write_over
from nav2_costmap_2d.sensor_messages import rotation_of, scan_points
from nav2_util.geometry import Pose2D
import numpy as np
import pytest
from sensor_msgs.msg import LaserScan

SQUARE = np.array([[0.2, 0.2], [0.2, -0.2], [-0.2, -0.2], [-0.2, 0.2]])


def test_published_scale():
    """Costs are published as from 0 to 100, and -1."""
    costs = np.array([0, 1, 126, 252, 253, 254, 255], np.uint8)
    assert occupancy_of(costs).tolist() == [0, 1, 49, 98, 99, 100, -1]


@pytest.mark.parametrize(
    ('options', 'expected'),
    [
        ({'track_unknown': True, 'trinary': True}, [0, 0, 0, 254, 255]),
        ({'track_unknown': False, 'trinary': True}, [0, 0, 0, 254, 0]),
        ({'track_unknown': True, 'trinary': False}, [0, 2, 127, 254, 255]),
    ],
)
def test_costs_of_maps(options, expected):
    """Occupancies of maps are free, occupied, unknown, or in proportion."""
    table = cost_table(100, 255, **options)
    assert table[[0, 1, 50, 100, 255]].tolist() == expected


def test_cells_and_points():
    """Points are in the cell whose corner is below and left of them."""
    grid = Costmap2D(4, 3, 0.5, -1.0, 2.0)
    grid.cells[1, 2] = 7
    assert grid.world_to_map(0.01, 2.51) == (2, 1)
    assert grid.map_to_world(2, 1) == (0.25, 2.75)
    assert grid.world_to_map(-1.01, 2.5) is None
    assert grid.world_to_map(1.0, 2.5) is None
    assert grid.cost_at(0.2, 2.7) == 7
    assert grid.cost_at(9.0, 9.0) == LETHAL_OBSTACLE
    points = [[0.2, 2.7], [-1.2, 2.1], [-0.9, 2.1]]
    assert grid.world_to_map_array(points).tolist() == [[2, 1], [-1, 0], [0, 0]]
    assert grid.costs_at(points).tolist() == [7, LETHAL_OBSTACLE, FREE_SPACE]
    assert grid.costs_at(points, outside=NO_INFORMATION)[1] == NO_INFORMATION
    assert grid.costs_at([[np.nan, 0.0]]).tolist() == [LETHAL_OBSTACLE]
    assert np.allclose(grid.map_to_world_array([[2, 1]]), [[0.25, 2.75]])


@pytest.mark.parametrize('shift', [(0, 0), (2, -1), (-3, 1), (10, 0), (0, -10)])
def test_shifted_grid_keeps_places(shift):
    """A grid that moves has the same costs at the same places."""
    generator = np.random.default_rng(1)
    grid = Costmap2D(6, 5, 0.1, 0.0, 0.0)
    grid.cells[...] = generator.integers(0, 200, grid.cells.shape)
    moved = grid.shifted(*shift, NO_INFORMATION)
    rows, columns = np.mgrid[0:5, 0:6]
    points = moved.map_to_world_array(np.stack([columns, rows], axis=-1))
    expected = grid.costs_at(points, outside=NO_INFORMATION)
    np.testing.assert_array_equal(moved.cells, expected)


def test_footprint_texts():
    """A footprint is a list of corners; everything else is explained."""
    assert parse_footprint('[]').shape == (0, 2)
    corners = parse_footprint(' [ [0.1, 0.2], [-0.1, 2], [-1, -1.5] ] ')
    assert corners.tolist() == [[0.1, 0.2], [-0.1, 2.0], [-1.0, -1.5]]
    for text, said in (
        ('[[1, 2], [3, 4]]', 'three corners'),
        ('[[1, 2], [3], [4, 5]]', r'corners \[x, y\]'),
        ('[1, 2', 'must be a list of corners, as'),
        ('true', r'corners \[x, y\]'),
    ):
        with pytest.raises(ValueError, match=said):
            parse_footprint(text)


def test_radii():
    """The inscribed radius is to the nearest side, the other to the farthest corner."""
    corners = np.array([[0.4, 0.1], [0.4, -0.1], [-0.2, -0.1], [-0.2, 0.1]])
    inscribed, circumscribed = radii_of(corners)
    assert inscribed == pytest.approx(0.1)
    assert circumscribed == pytest.approx(math.hypot(0.4, 0.1))
    assert pad(corners, 0.05)[0].tolist() == pytest.approx([0.45, 0.15])
    circle = Footprint.of_radius(0.3)
    assert circle.is_circular
    assert circle.inscribed_radius_m == pytest.approx(0.3, rel=0.03)


def test_collisions_of_footprints():
    """The highest cost on the outline counts, outside is lethal, unknown less than obstacles."""
    grid = Costmap2D(40, 40, 0.05, -1.0, -1.0)
    grid.cells[20, 24] = LETHAL_OBSTACLE  # at 0.2 to 0.25, 0 to 0.05
    grid.cells[:, :8] = NO_INFORMATION
    checker = FootprintCollisionChecker(grid)
    assert checker.footprint_cost(Pose2D(0.0, 0.0, 0.0), SQUARE) == LETHAL_OBSTACLE
    assert checker.footprint_cost(Pose2D(-0.1, 0.0, 0.0), SQUARE) == FREE_SPACE
    assert checker.footprint_cost(Pose2D(-0.05, 0.0, math.pi / 4), SQUARE) == LETHAL_OBSTACLE
    assert checker.footprint_cost(Pose2D(-0.5, 0.0, 0.0), SQUARE) == NO_INFORMATION
    assert checker.footprint_cost(Pose2D(0.9, 0.0, 0.0), SQUARE) == LETHAL_OBSTACLE
    grid.cells[20, 13] = LETHAL_OBSTACLE
    poses = [(-0.52, 0.02, 0.0), (0.0, 0.5, 0.3), (0.22, 0.02, 0.0)]
    costs = checker.footprint_costs(poses, SQUARE)
    assert costs.tolist() == [LETHAL_OBSTACLE, FREE_SPACE, FREE_SPACE]
    assert checker.footprint_costs(poses, None)[2] == LETHAL_OBSTACLE


@pytest.mark.parametrize(
    ('cost', 'is_circular', 'allow_unknown', 'collides'),
    [
        (INSCRIBED_INFLATED_OBSTACLE, True, True, True),
        (INSCRIBED_INFLATED_OBSTACLE, False, True, False),
        (LETHAL_OBSTACLE, False, True, True),
        (NO_INFORMATION, True, True, False),
        (NO_INFORMATION, False, False, True),
        (100, True, False, False),
    ],
)
def test_what_a_collision_is(cost, is_circular, allow_unknown, collides):
    """A circle collides at its centre's cost, others only with obstacles on the outline."""
    found = is_collision(cost, is_circular=is_circular, allow_unknown=allow_unknown)
    assert found is collides


def decayed_cost(distance_m, inscribed_radius_m, scaling):
    """Return the cost at a distance from the middle of the nearest obstacle's cell."""
    if distance_m <= 0.0:
        return LETHAL_OBSTACLE
    if distance_m <= inscribed_radius_m:
        return INSCRIBED_INFLATED_OBSTACLE
    decay = math.exp(-scaling * (distance_m - inscribed_radius_m))
    return int((INSCRIBED_INFLATED_OBSTACLE - 1) * decay)


def test_inflation_is_that_of_the_distance():
    """Each cell costs what its distance from the nearest obstacle says."""
    generator = np.random.default_rng(2)
    grid = Costmap2D(50, 40, 0.1, 0.0, 0.0)
    obstacles = generator.integers(0, (40, 50), (6, 2))
    grid.cells[obstacles[:, 0], obstacles[:, 1]] = LETHAL_OBSTACLE
    Inflation(0.75, 0.25, 4.0).apply(grid, Region.whole(grid))
    rows, columns = np.mgrid[0:40, 0:50]
    away = np.hypot(rows[..., None] - obstacles[:, 0], columns[..., None] - obstacles[:, 1])
    distances = away.min(axis=-1) * 0.1
    for distance, cost in zip(distances.flat, grid.cells.flat):
        expected = decayed_cost(distance, 0.25, 4.0) if distance <= 0.8 + 1e-9 else 0
        assert cost == expected, distance


def test_inflation_of_unknown_cells():
    """Unknown cells get costs of collisions, all costs, or count as obstacles."""

    def inflated(**options):
        grid = Costmap2D(9, 1, 0.1, 0.0, 0.0)
        grid.cells[0] = [LETHAL_OBSTACLE, 255, 255, 255, 0, 0, 0, 0, 0]
        Inflation(0.6, 0.1, 1.0, **options).apply(grid, Region.whole(grid))
        return grid.cells[0].tolist()

    assert inflated()[:4] == [254, 253, 255, 255]
    assert inflated(inflates_unknown=True)[:4] == [
        254,
        253,
        *(decayed_cost(d, 0.1, 1.0) for d in (0.2, 0.3)),
    ]
    assert inflated()[5] == decayed_cost(0.5, 0.1, 1.0)
    assert inflated(inflates_around_unknown=True)[3:6] == [255, 253, decayed_cost(0.2, 0.1, 1.0)]


def ring(radius_m, count=72):
    angles = np.arange(count) * (2.0 * math.pi / count)
    points = np.column_stack([np.cos(angles), np.sin(angles), np.full(count, 0.3 / radius_m)])
    return Observation(np.array([0.0, 0.0, 0.3]), points * radius_m)


def test_rays_clear_up_to_their_ranges():
    """Rays clear from the lowest to the highest range, and not beyond their ends."""
    grid = Costmap2D(80, 80, 0.05, -2.0, -2.0, NO_INFORMATION)
    clear_rays(grid, ring(1.5), 0.0, 1.0)
    assert grid.cost_at(0.01, 0.01) == FREE_SPACE
    assert grid.cost_at(0.9, 0.01) == FREE_SPACE
    assert grid.cost_at(1.1, 0.01) == NO_INFORMATION
    grid = Costmap2D(80, 80, 0.05, -2.0, -2.0, NO_INFORMATION)
    clear_rays(grid, ring(1.5), 0.5, 9.0)
    assert grid.cost_at(0.4, 0.01) == NO_INFORMATION
    assert grid.cost_at(0.7, 0.01) == FREE_SPACE
    assert grid.cost_at(1.6, 0.01) == NO_INFORMATION
    clear_rays(grid, Observation(np.zeros(3), np.empty((0, 3))), 0.0, 9.0)
    clear_rays(grid, Observation(np.zeros(3), np.full((1, 3), 1e6)), 0.0, math.inf)


def test_points_mark_between_limits():
    """Points mark within ranges and heights, and if they are enough."""
    points = np.array(
        [[0.5, 0.0, 0.3], [1.5, 0.0, 0.3], [0.0, 0.5, 1.5], [0.0, -0.5, 0.3], [9.0, 0.0, 0.3]]
    )
    seen = Observation(
        np.array([0.0, 0.0, 0.3]), points, np.array([True, True, True, False, True])
    )
    grid = Costmap2D(80, 80, 0.05, -2.02, -2.02)
    mark_points(grid, seen, 0.2, 1.0, (0.0, 1.0))
    assert (grid.cells == LETHAL_OBSTACLE).sum() == 1
    assert grid.cost_at(0.5, 0.0) == LETHAL_OBSTACLE
    grid = Costmap2D(80, 80, 0.05, -2.02, -2.02)
    mark_points(grid, seen, 0.0, 99.0, threshold=1)
    assert not grid.cells.any()


def test_points_of_a_scan():
    """Ranges beyond the limits are left out; infinite ones are free if that is wanted."""
    scan = LaserScan(angle_min=0.0, angle_increment=math.pi / 2, range_min=0.1, range_max=5.0)
    scan.ranges = [1.0, math.inf, math.nan, 0.05]
    points, is_hit = scan_points(scan, inf_is_valid=False)
    assert points.tolist() == [[1.0, 0.0, 0.0]] and is_hit is None
    points, is_hit = scan_points(scan, inf_is_valid=True)
    assert np.allclose(points, [[1.0, 0.0, 0.0], [0.0, 5.0, 0.0]])
    assert is_hit.tolist() == [True, False]


def test_rotation():
    """A quarter turn around z takes x to y."""
    turned = Transform()
    turned.rotation.z = turned.rotation.w = math.sqrt(0.5)
    assert np.allclose(rotation_of(turned) @ [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])


def test_ways_to_join():
    """A layer raises or replaces costs where it knows something."""
    below = np.array([0, 100, 255, 255, 254], np.uint8)
    added = np.array([50, 50, 50, 255, 255], np.uint8)
    for write, expected in (
        (write_maximum, [50, 100, 50, 255, 254]),
        (lambda a, b: write_maximum(a, b, keep_unknown=True), [50, 100, 255, 255, 254]),
        (write_over, [50, 50, 50, 255, 254]),
    ):
        cells = below.copy()
        write(cells, added)
        assert cells.tolist() == expected


class Painter(Layer):
    """A layer with obstacles at places that tests set."""

    def __init__(self, cells):
        super().__init__('painter')
        self.cells, self.changed = cells, None

    def paint(self, row, column, cost):
        self.cells[row, column] = cost
        self.changed = Region(column, row, column + 1, row + 1).union(self.changed)

    def update(self, grid, robot):
        region, self.changed = self.changed, None
        return region

    def apply(self, grid, region):
        write_maximum(grid.cells[region.slices], self.cells[region.slices])


class Inflater(Layer):
    def affected(self, region):
        return region.grown(6)

    def apply(self, grid, region):
        Inflation(0.3, 0.1, 3.0).apply(grid, region)


def test_changes_make_what_everything_anew_makes():
    """A costmap of which only changes are made anew is the same as one made at once."""
    generator = np.random.default_rng(4)
    start = Costmap2D(60, 50, 0.05, 0.0, 0.0)
    costmap = LayeredCostmap(start, FREE_SPACE, is_rolling=False)
    painter = Painter(np.full(start.cells.shape, NO_INFORMATION, np.uint8))
    costmap.layers += [painter, Inflater('inflater')]
    assert costmap.update(None) == Region.whole(start)
    assert costmap.update(None) is None
    for _ in range(30):
        for row, column in generator.integers(0, (50, 60), (3, 2)):
            painter.paint(row, column, generator.choice([LETHAL_OBSTACLE, NO_INFORMATION]))
        before = costmap.grid
        kept = before.cells.copy()
        region = costmap.update(None)
        assert costmap.grid is not before
        np.testing.assert_array_equal(before.cells, kept)
        found = costmap.grid.cells.copy()
        changed = Region.of_mask(found != kept)
        assert changed is None or region.union(changed) == region
        costmap.touch()
        costmap.update(None)
        np.testing.assert_array_equal(found, costmap.grid.cells)


def test_regions():
    """Regions grow, unite and are clipped; cells are forgotten inside or outside."""
    grid = Costmap2D(10, 8, 0.1, 0.0, 0.0)
    region = Region(1, 2, 3, 4)
    assert region.grown(2) == Region(-1, 0, 5, 6)
    assert region.grown(2).clipped(grid) == Region(0, 0, 5, 6)
    assert Region(20, 0, 30, 5).clipped(grid) is None
    assert region.union(Region(5, 0, 6, 1)) == Region(1, 0, 6, 4)
    forget_cells(grid, region, is_inverted=False)
    assert (grid.cells == NO_INFORMATION).sum() == 4
    forget_cells(grid, Region(0, 0, 2, 8), is_inverted=True)
    assert (grid.cells == NO_INFORMATION).sum() == 80 - 14
    assert Region.of_mask(grid.cells == FREE_SPACE) == Region(0, 0, 2, 8)


def test_small_groups_are_noise():
    """Groups of obstacles with too few cells are removed."""
    cells = np.zeros((6, 8), np.uint8)
    cells[0, 0] = cells[2, 2] = cells[3, 3] = cells[5, 5] = cells[5, 6] = LETHAL_OBSTACLE
    for connectivity, left in ((8, 4), (4, 2)):
        found = cells.copy()
        remove_small_groups(found, 2, connectivity)
        assert (found == LETHAL_OBSTACLE).sum() == left


def test_messages_keep_the_grid():
    """A costmap is the same after it was a message."""
    grid = Costmap2D(3, 2, 0.05, -1.5, 0.25)
    grid.cells[...] = [[0, 253, 254], [255, 1, 252]]
    stamp = make_grid(grid, 'map', LaserScan().header.stamp).header.stamp
    found = costmap_from(make_costmap_message(grid, 'map', stamp))
    np.testing.assert_array_equal(found.cells, grid.cells)
    assert (found.resolution, found.origin_x, found.origin_y) == (0.05, -1.5, 0.25)
    shown = make_grid(grid, 'map', stamp)
    assert list(shown.data) == [0, 99, 100, -1, 1, 98]
    broken = make_costmap_message(grid, 'map', stamp)
    broken.metadata.size_x = 9
    with pytest.raises(ValueError, match='6 cells'):
        costmap_from(broken)
