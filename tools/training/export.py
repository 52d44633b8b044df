#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write the best weights of a training as an ONNX file."""

from __future__ import annotations

import argparse
from pathlib import Path

from checkpoints import load
import onnx
from onnx_graph import model_of
from train import DATA, make_optimizer

MODEL = (
    Path(__file__).resolve().parents[2]
    / 'src' / 'humanoid_perception' / 'models' / 'apartment_things.onnx'
)  # fmt: skip


def main() -> None:
    """Write the file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--data', type=Path, default=DATA, help='the folder of the training')
    parser.add_argument('--model', type=Path, default=MODEL, help='the file to write')
    arguments = parser.parse_args()
    best = arguments.data / 'run' / 'best.npz'
    if not best.exists():
        parser.error(f'{best} is not there. Train first: train.py --data {arguments.data}')
    state = load(best, make_optimizer(1), 0)
    said = {
        'description': 'Things of an apartment in pictures of the simulator',
        'author': 'Humanoid workspace maintainers',
        'license': 'Apache-2.0',
        'version': f'{state["step"]} steps',
    }
    model = model_of(state['averaged'], state['averaged_statistics'], said)
    onnx.save(model, arguments.model)
    print(f'{arguments.model}: {arguments.model.stat().st_size} bytes, step {state["step"]}')


if __name__ == '__main__':
    main()
