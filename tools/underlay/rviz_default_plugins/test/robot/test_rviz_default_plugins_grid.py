# SPDX-License-Identifier: Apache-2.0
"""The lines of grids, and where they are."""

from __future__ import annotations

import numpy as np
import pytest
from rviz_default_plugins.displays.grid_and_axes import Grid, GridSize, in_pieces, lines
from stage import sentence, Stage


@pytest.mark.parametrize(('plane', 'across'), [('XY', 2), ('XZ', 1), ('YZ', 0)])
def test_plane(plane: str, across: int) -> None:
    """A flat grid has no extent across its plane, and is centred in it."""
    found = lines(GridSize(4, 0, 0.5), plane)
    assert found.shape == (10, 2, 3)
    assert np.ptp(found[:, :, across]) == 0.0
    others = [axis for axis in range(3) if axis != across]
    assert found[:, :, others].min() == -1.0
    assert found[:, :, others].max() == 1.0


@pytest.mark.parametrize('size', [GridSize(1, 0, 1.0), GridSize(3, 2, 1.0), GridSize(10, 1, 0.1)])
def test_line_count(size: GridSize) -> None:
    """The number of lines is known before they are made, and no line is there twice."""
    found = lines(size, 'XY')
    assert len(found) == size.line_count
    assert len(np.unique(found.reshape(-1, 6), axis=0)) == len(found)


def test_pieces() -> None:
    """The pieces of a line follow each other from its one end to the other."""
    whole = np.array([[[0, 0, 0], [4, 0, 2]], [[1, 1, 1], [1, 5, 1]]], np.float32)
    found = in_pieces(whole, 4)
    assert found.shape == (8, 2, 3)
    assert found[:4, 0, 0].tolist() == [0, 1, 2, 3] and found[:4, 1, 0].tolist() == [1, 2, 3, 4]
    assert found[4].tolist() == [[1, 1, 1], [1, 2, 1]] and found[7, 1].tolist() == [1, 5, 1]


@pytest.mark.parametrize('size', [GridSize(10**9, 0, 1.0), GridSize(10**9, 10**9, 1.0)])
def test_grids_that_are_too_large(size: GridSize) -> None:
    """A grid with too many lines is reduced to nearly as many as may be."""
    assert 0.4 * 20000 < size.within(20000).line_count <= 20000


def test_grid(stage: Stage) -> None:
    """The properties of a file lead to lines."""
    stage.show(
        Grid,
        {
            'Alpha': 0.5,
            'Cell Size': 2,
            'Color': '248; 48; 48',
            'Line Style': {'Line Width': 0.05, 'Value': 'Billboards'},
            'Offset': {'X': 1, 'Y': 2, 'Z': 3},
            'Plane Cell Count': 2,
            'Plane': 'XZ',
        },
    )
    node = stage.node_at('/display_0/lines')
    assert len(node.points) == 6, 'short lines have one piece'
    assert (node.thickness, node.thickness_units) == (0.05, 'world')
    assert node.position.tolist() == [1.0, 2.0, 3.0]
    assert node.colors.tolist() == [148, 48, 48]


def test_grid_follows_its_frame(stage: Stage) -> None:
    """A grid is where its frame is, and not seen with a reason if that is not known."""
    grid = stage.show(Grid, {'Reference Frame': 'odom'})
    grid.update()
    assert not stage.node_at('/display_0').visible
    assert 'odom' in sentence(grid, 'Transform')
    stage.move('map', 'odom', x=2.0)
    grid.update()
    assert stage.node_at('/display_0').visible
    assert stage.node_at('/display_0').position.tolist() == [2.0, 0.0, 0.0]
    assert sentence(grid, 'Transform') == ''


def test_huge_grid(stage: Stage) -> None:
    """A grid that no browser can draw is reduced, and says so with both numbers."""
    grid = stage.show(Grid, {'Plane Cell Count': 10**7})
    assert len(stage.node_at('/display_0/lines').points) <= 20000
    assert '20000002 lines are too many' in sentence(grid, 'Grid')
