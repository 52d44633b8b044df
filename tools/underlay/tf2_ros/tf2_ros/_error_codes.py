# SPDX-License-Identifier: Apache-2.0
"""Convert tf2 exceptions to TF2Error messages and back."""

from __future__ import annotations

from tf2_msgs.msg import TF2Error
from tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

_CODES = {
    LookupException: TF2Error.LOOKUP_ERROR,
    ConnectivityException: TF2Error.CONNECTIVITY_ERROR,
    ExtrapolationException: TF2Error.EXTRAPOLATION_ERROR,
    InvalidArgumentException: TF2Error.INVALID_ARGUMENT_ERROR,
    TimeoutException: TF2Error.TIMEOUT_ERROR,
}


def to_message(error: TransformException) -> TF2Error:
    """
    Convert a tf2 exception to a `tf2_msgs/TF2Error`.

    Parameters
    ----------
    error
        The exception; types without their own error code become TRANSFORM_ERROR.

    """
    code = _CODES.get(type(error), TF2Error.TRANSFORM_ERROR)
    return TF2Error(error=code, error_string=str(error))


def raise_error(message: TF2Error) -> None:
    """
    Raise the tf2 exception that corresponds to a `tf2_msgs/TF2Error`, if any.

    Parameters
    ----------
    message
        The error of an action result; nothing is raised for NO_ERROR.

    Raises
    ------
    TransformException
        The subclass for the error code, or the base class if the code is unknown.

    """
    if message.error == TF2Error.NO_ERROR:
        return
    for kind, code in _CODES.items():
        if code == message.error:
            raise kind(message.error_string)
    raise TransformException(message.error_string)
