# SPDX-License-Identifier: Apache-2.0
"""The network of a policy: its ONNX file, which onnxruntime runs on one core."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from humanoid_control.backends import Array
from humanoid_control.policy.observation import Vector
from humanoid_control.policy.policy_file import PolicyFile
import numpy as np


class Network(Protocol):
    """What turns the input of a policy into an action."""

    def run(self, observation: Vector) -> Array:
        """
        Compute an action.

        Parameters
        ----------
        observation
            The input (1, size).

        Returns
        -------
        Array
            The action (m,).

        Raises
        ------
        PolicyError
            The network cannot be run.

        """


class OnnxNetwork:
    """
    The network in the ONNX file of a policy.

    Parameters
    ----------
    file
        The policy file, which says what the network observes and how many joints it moves.

    Raises
    ------
    PolicyError
        onnxruntime is missing, or the file is, or it does not fit.

    """

    def __init__(self, file: PolicyFile) -> None:
        self._file = file
        self._session = _session(file)
        self._input = _checked_input(file, self._session.get_inputs())
        self._output = _checked_output(file, self._session.get_outputs())
        self.run(np.zeros((1, file.input_size), dtype=np.float32))

    def run(self, observation: Vector) -> Array:
        """
        Compute an action, as for `Network.run`.

        Parameters
        ----------
        observation
            The input (1, size).

        Returns
        -------
        Array
            The action (m,).

        Raises
        ------
        PolicyError
            onnxruntime cannot run the network, or it returns another number of values.

        """
        try:
            output = self._session.run([self._output], {self._input: observation})[0]
        except Exception as error:  # onnxruntime's errors share no other class
            raise self._file.error(
                f'onnxruntime cannot run its network: {_first_line(error)} Export it again.'
            ) from None
        action: Array = np.asarray(output, dtype=np.float64).ravel()
        if len(action) != len(self._file.joints):
            raise self._file.error(_wrong_output(self._file, np.shape(output)))
        return action


def _session(file: PolicyFile) -> Any:
    """Open the network."""
    if not file.model.is_file():
        raise file.error(
            f"Its network '{file.model}' is not there. Correct 'model', which is the name of an "
            'ONNX file beside the policy file.'
        )
    try:
        import onnxruntime
    except ImportError as error:
        raise file.error(
            f"The mode 'policy' needs onnxruntime, which cannot be imported: {error}. Install "
            'that Python package.'
        ) from None
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.execution_mode = onnxruntime.ExecutionMode.ORT_SEQUENTIAL
    options.log_severity_level = 4
    try:
        return onnxruntime.InferenceSession(
            str(file.model), options, providers=['CPUExecutionProvider']
        )
    except Exception as error:  # onnxruntime's errors share no other class
        raise file.error(
            f"Its network '{file.model}' cannot be loaded: {_first_line(error)} It is truncated, "
            'not ONNX, or newer than the installed onnxruntime '
            f'({onnxruntime.__version__}). Copy or export it again.'
        ) from None


def _checked_input(file: PolicyFile, inputs: Sequence[Any]) -> str:
    """Return the name of the input of a network."""
    if len(inputs) != 1:
        raise file.error(
            f'Its network has {len(inputs)} inputs: {_listed(inputs)}. It must have one, the '
            'observation; a recurrent network is not supported.'
        )
    (found,) = inputs
    if found.type != 'tensor(float)':
        raise file.error(f'The input of its network is {found.type}, not tensor(float).')
    if len(found.shape) != 2 or not (
        _fits(found.shape[0], 1) and _fits(found.shape[1], file.input_size)
    ):
        steps = f', each {file.history_length} times' if file.history_length > 1 else ''
        terms = ', '.join(f'{term.name} {term.size}' for term in file.terms)
        raise file.error(
            f'The input of its network has the shape {found.shape}, but the file describes '
            f'[1, {file.input_size}]: {terms}{steps}. Correct the terms under '
            "'observation', or export the network again."
        )
    return str(found.name)


def _checked_output(file: PolicyFile, outputs: Sequence[Any]) -> str:
    """Return the name of the first output of a network, which must be the action."""
    found = outputs[0]
    if found.type != 'tensor(float)':
        raise file.error(f'The output of its network is {found.type}, not tensor(float).')
    if len(found.shape) != 2 or not _fits(found.shape[1], len(file.joints)):
        raise file.error(_wrong_output(file, found.shape))
    return str(found.name)


def _wrong_output(file: PolicyFile, shape: Sequence[Any]) -> str:
    return (
        f'The output of its network has the shape {list(shape)}, but the file has '
        f"{len(file.joints)} joints: it must be [1, {len(file.joints)}]. Correct 'joints', or "
        'export the network again.'
    )


def _fits(dimension: Any, size: int) -> bool:
    """Whether a dimension has a size; one that is a name, or unknown, takes any."""
    return not isinstance(dimension, int) or dimension == size


def _listed(inputs: Sequence[Any]) -> str:
    return ', '.join(f'{each.name} {each.shape}' for each in inputs)


def _first_line(error: Exception) -> str:
    text = str(error).strip() or type(error).__name__
    first = text.splitlines()[0]
    return first if first.endswith('.') else f'{first}.'
