# SPDX-License-Identifier: Apache-2.0
"""
The network of the detector, in training and in its file; see tools/training/requirements.txt.

In an environment that has nothing but those packages and pytest:
python3 -m pytest --noconftest -c /dev/null tools/test/test_training_network.py
"""

from __future__ import annotations

from pathlib import Path
import sys
from typing import Any

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'training'))

for name in ('jax', 'optax', 'onnx', 'onnxruntime'):
    pytest.importorskip(name, reason='packages of tools/training/requirements.txt')

from batches import Batch  # noqa: E402
from boxes import Cells, decoded  # noqa: E402
from checkpoints import load, save, start  # noqa: E402
from jax_operations import initial_weights, outputs  # noqa: E402
from losses import flat  # noqa: E402
from network import HEIGHT_PX, OUTPUTS, WIDTH_PX  # noqa: E402
from onnx_graph import model_of  # noqa: E402
import onnxruntime  # noqa: E402
from pictures import CLASSES  # noqa: E402
from train import make_optimizer, make_step  # noqa: E402

EDGE_PX = 64
MOST_BYTES = 1_000_000


def trained() -> tuple[dict[str, Any], dict[str, Any]]:
    """Return weights and statistics of which no number is the one that training begins with."""
    generator = np.random.default_rng(1)
    weights, statistics = initial_weights(1)
    for name, value in statistics.items():
        statistics[name] = value + generator.uniform(0.0, 0.3, value.shape).astype(np.float32)
    for name, value in weights.items():
        if name.endswith(('/shift', '/bias')):
            weights[name] = value + generator.normal(0.0, 0.2, value.shape).astype(np.float32)
    return weights, statistics


def test_file_computes_what_was_trained() -> None:
    """The ONNX graph decodes the boxes and scores of the network; rounding costs little."""
    weights, statistics = trained()
    model = model_of(weights, statistics, {})
    content = model.SerializeToString()
    assert len(content) < MOST_BYTES
    session = onnxruntime.InferenceSession(content, providers=['CPUExecutionProvider'])
    picture = np.random.default_rng(2).random((1, HEIGHT_PX, WIDTH_PX, 3), np.float32)
    (result,) = session.run(None, {'images': picture.transpose(0, 3, 1, 2)})
    raw = np.asarray(flat(outputs(weights, statistics, picture)[0]))[0]
    boxes = decoded(np, raw[:, :4], Cells.of(HEIGHT_PX, WIDTH_PX))
    scores = 1.0 / (1.0 + np.exp(-raw[:, 4:]))
    assert result.shape == (1, OUTPUTS, len(boxes))
    assert result[0, :4].T == pytest.approx(boxes, rel=0.02, abs=0.5)
    assert result[0, 4:].T == pytest.approx(scores, rel=0.05, abs=0.005)
    said = session.get_modelmeta().custom_metadata_map
    assert said['task'] == 'detect' and said['names'] == str(dict(enumerate(CLASSES)))


def batch(step: int) -> Batch:
    """Return pictures of one bright square."""
    generator = np.random.default_rng(step)
    shown = generator.integers(0, 60, (2, EDGE_PX, EDGE_PX, 3)).astype(np.uint8)
    shown[:, 20:36, 24:40] = 250
    cells = Cells.of(EDGE_PX, EDGE_PX)
    is_near = np.abs(cells.centres_px - (32.0, 28.0)).max(axis=1) < 4.0
    classes = np.where(is_near, 4, -1).astype(np.int32)
    boxes = np.tile(np.array([24, 20, 40, 36], np.float32), (2, len(classes), 1))
    weights = np.ones((2, len(classes)), np.float32)
    return Batch(shown, boxes, np.tile(classes, (2, 1)), weights)


def advanced(state: dict[str, Any], step: Any, count: int) -> tuple[dict[str, Any], float]:
    """Return the state after some more steps, and the last loss."""
    loss = float('nan')
    for _ in range(count):
        now, done = batch(state['step']), state['step'] + 1
        parts = {name: value for name, value in state.items() if name != 'step'}
        parts, loss = step(parts, now.pictures, now.boxes, now.classes, now.weights, 0.5)
        state = {**parts, 'step': done}
    return state, float(loss)


def test_training_goes_on_where_it_was_interrupted(tmp_path: Path) -> None:
    """Four steps are the same as two, a checkpoint, and two more; and they learn something."""
    optimizer = make_optimizer(100)
    step = make_step(optimizer)
    half, first_loss = advanced(start(optimizer, 1), step, 2)
    whole, last_loss = advanced(half, step, 2)
    save(tmp_path / 'checkpoint.npz', half)
    resumed, _ = advanced(load(tmp_path / 'checkpoint.npz', optimizer, 1), step, 2)
    assert resumed['step'] == whole['step'] == 4
    for part in ('weights', 'averaged', 'averaged_statistics'):
        for name, value in whole[part].items():
            assert np.asarray(resumed[part][name]) == pytest.approx(np.asarray(value), abs=1e-5)
    assert last_loss < first_loss
