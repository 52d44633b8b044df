# SPDX-License-Identifier: Apache-2.0
"""Check networks in ONNX files: they run, or a sentence says why not."""

from __future__ import annotations

from pathlib import Path
import sys

from humanoid_common.onnx_file import Operation, Tensor, write_onnx
from humanoid_control.policy import OnnxNetwork, PolicyError, read_policy_file
from humanoid_control.policy.testing import write
import numpy as np
import pytest

pytest.importorskip('onnxruntime')

INPUT, OUTPUT = Tensor('obs', [1, 4]), Tensor('actions', [1, 2])


def refusal(folder: Path, observation: Tensor, *others: Tensor, action: Tensor = OUTPUT) -> str:
    """Return the sentence about a network that adds up what it observes."""
    size = (int(observation.shape[1]), int(action.shape[1]))
    if observation.kind == 'float32':
        add = Operation('MatMul', [observation.name, 'weights'], action.name)
    else:
        add = Operation('Identity', ['weights'], action.name)
    weights = np.ones(size if observation.kind == 'float32' else (1, 2), dtype=np.float32)
    write_onnx(
        folder / 'moves.onnx', [add], {'weights': weights}, [observation, *others], [action]
    )
    with pytest.raises(PolicyError) as caught:
        OnnxNetwork(read_policy_file(write(folder)))
    assert f"The policy '{folder / 'moves.yaml'}' cannot be run." in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize('batch', [1, 'batch'])
def test_it_computes(tmp_path: Path, batch: int | str) -> None:
    """With a batch of one, or of any size."""
    weights = np.array([[1, 2], [3, 4], [5, 6], [7, 8]], dtype=np.float32)
    write_onnx(
        tmp_path / 'moves.onnx',
        [Operation('MatMul', ['obs', 'weights'], 'sum'), Operation('Tanh', ['sum'], 'actions')],
        {'weights': weights},
        [Tensor('obs', [batch, 4])],
        [Tensor('actions', [batch, 2])],
    )
    network = OnnxNetwork(read_policy_file(write(tmp_path)))
    observation = np.array([[0.1, 0.0, -0.1, 0.02]], dtype=np.float32)
    assert network.run(observation) == pytest.approx(np.tanh(observation @ weights)[0], abs=1e-6)


def test_networks_that_do_not_fit(tmp_path: Path) -> None:
    """The shape of the input and of the output, their types, and their number."""
    sentence = refusal(tmp_path, Tensor('obs', [1, 9]))
    assert 'has the shape [1, 9], but the file describes [1, 4]' in sentence
    assert 'joint_pos_rel 2, last_action 2' in sentence
    sentence = refusal(tmp_path, INPUT, action=Tensor('actions', [1, 7]))
    assert 'has the shape [1, 7], but the file has 2 joints' in sentence
    sentence = refusal(tmp_path, INPUT, Tensor('state', [1, 8]))
    assert 'has 2 inputs' in sentence and 'recurrent' in sentence
    assert 'tensor(float16)' in refusal(tmp_path, Tensor('obs', [1, 4], 'float16'))


def test_files_that_are_no_network(tmp_path: Path) -> None:
    """None there, and another file."""
    file = read_policy_file(write(tmp_path))
    with pytest.raises(PolicyError, match=r"moves.onnx' is not there. Correct 'model'"):
        OnnxNetwork(file)
    (tmp_path / 'moves.onnx').write_text('no network')
    with pytest.raises(PolicyError, match=r'cannot be loaded.*Copy or export it again'):
        OnnxNetwork(file)


def test_without_onnxruntime(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The sentence names the package."""
    monkeypatch.setitem(sys.modules, 'onnxruntime', None)
    (tmp_path / 'moves.onnx').write_text('any')
    with pytest.raises(PolicyError, match=r'needs onnxruntime, .* Install that Python package'):
        OnnxNetwork(read_policy_file(write(tmp_path)))
