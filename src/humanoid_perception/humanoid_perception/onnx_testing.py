# SPDX-License-Identifier: Apache-2.0
"""Write ONNX files of networks with a constant output, for tests, without the package onnx."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from humanoid_common.onnx_file import Operation, Tensor, write_onnx
import numpy as np
import numpy.typing as npt

__all__ = ['write_constant_network']


def write_constant_network(
    path: Path,
    output: npt.ArrayLike,
    shape: Sequence[int | str] = (1, 3, 320, 320),
    metadata: Mapping[str, str] | None = None,
    kind: str = 'float32',
) -> Path:
    """
    Write a network with the same output for every image, and return its path.

    Parameters
    ----------
    path
        The file to write.
    output
        The constant output.
    shape
        The shape of its input `images`; a dimension that is a name is dynamic.
    metadata
        The metadata of the model, such as `names`.
    kind
        The type of the input: `float32`, `float16` or `uint8`.

    """
    values = np.asarray(output, dtype=np.float32)
    write_onnx(
        path,
        [Operation('Identity', ['constant'], 'output0')],
        {'constant': values},
        [Tensor('images', shape, kind)],
        [Tensor('output0', values.shape)],
        metadata or {},
    )
    return path
