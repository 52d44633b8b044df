# SPDX-License-Identifier: Apache-2.0
"""The loggers of the output of processes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
import logging
from typing import Union

from launch.logging import launch_config, logger_at
from launch.logging._handlers import (
    bare_formatter,
    label_formatter,
    LogFileHandler,
    ScreenHandler,
    stamped_formatter,
)

OutputConfig = Union[str, Mapping[str, Union[str, Collection[str]]]]

_PRESETS: dict[str, dict[str, tuple[str, ...]]] = {
    'screen': {'both': ('screen',)},
    'log': {'both': ('log',), 'stderr': ('screen',)},
    'both': {'both': ('screen', 'log')},
    'own_log': {'both': ('own_log',), 'stdout': ('own_log',), 'stderr': ('own_log',)},
    'full': {'both': ('screen', 'log', 'own_log'), 'stdout': ('own_log',), 'stderr': ('own_log',)},
}
_DESTINATIONS = frozenset(('screen', 'log', 'own_log'))
_STREAMS = ('stdout', 'stderr', 'both')


def normalize_output_config(config: OutputConfig) -> dict[str, frozenset[str]]:
    """
    Resolve where the output streams of a process go.

    Parameters
    ----------
    config
        The name of a preset (screen, log, both, own_log or full), or the destinations (screen, log
        or own_log) of stdout, stderr and both.

    Returns
    -------
    dict of str to frozenset of str
        The destinations of each of the three.

    Raises
    ------
    ValueError
        There is no such preset, stream or destination.

    """
    if isinstance(config, str):
        if config not in _PRESETS:
            raise ValueError(
                f'{config} is not a valid standard output config i.e. "screen", "log" or "both"'
            )
        config = _PRESETS[config]
    unknown = sorted(set(config) - set(_STREAMS))
    if unknown:
        raise ValueError(
            f"'{unknown[0]}' is not a stream of a process; the output can be set for stdout, "
            'stderr and both'
        )
    return {stream: _destinations(config.get(stream, ())) for stream in _STREAMS}


def _destinations(names: Union[str, Iterable[str]]) -> frozenset[str]:
    result = frozenset([names] if isinstance(names, str) else names)
    unknown = sorted(result - _DESTINATIONS)
    if unknown:
        raise ValueError(
            f'{unknown[0]} is not a valid standard output config i.e. "screen", "log" or '
            '"own_log" for a single stream'
        )
    return result


def get_output_loggers(
    process_name: str,
    output_config: OutputConfig,
) -> tuple[logging.Logger, logging.Logger]:
    """
    Get the loggers of the standard output and the standard error of a process.

    Parameters
    ----------
    process_name
        The label of the process, by which its loggers and log files are named.
    output_config
        Where the output goes, as for `normalize_output_config`.

    Returns
    -------
    tuple of Logger
        That of the standard output, and that of the standard error.

    Raises
    ------
    ValueError
        The configuration is not valid.

    """
    config = normalize_output_config(output_config)
    stdout, stderr = (_logger(process_name, stream, config) for stream in ('stdout', 'stderr'))
    return stdout, stderr


def _logger(
    process_name: str,
    stream: str,
    config: dict[str, frozenset[str]],
) -> logging.Logger:
    logger = logger_at(f'{process_name}-{stream}', logging.INFO)
    logger.propagate = False
    logger.handlers = []
    wanted = config[stream] | config['both']
    if 'screen' in wanted:
        logger.addHandler(_with(ScreenHandler(), label_formatter(process_name)))
    if 'log' in wanted:
        logger.addHandler(_file('launch.log', stamped_formatter()))
    if 'own_log' in config[stream]:
        logger.addHandler(_file(f'{process_name}-{stream}.log', bare_formatter()))
    if 'own_log' in config['both']:
        logger.addHandler(_file(f'{process_name}.log', bare_formatter()))
    return logger


def is_on_screen(logger: logging.Logger) -> bool:
    """
    Whether a logger writes to the screen.

    Parameters
    ----------
    logger
        One of the loggers of `get_output_loggers`.

    """
    return any(isinstance(handler, ScreenHandler) for handler in logger.handlers)


def _file(file_name: str, formatter: logging.Formatter) -> logging.Handler:
    """Create a handler with a format of its own that shares the file of the main handler."""
    return _with(_Forward(launch_config.get_log_file_handler(file_name)), formatter)


def _with(handler: logging.Handler, formatter: logging.Formatter) -> logging.Handler:
    handler.setFormatter(formatter)
    return handler


class _Forward(logging.Handler):
    """Handler that writes records in another format to the file of a handler."""

    def __init__(self, target: LogFileHandler) -> None:
        """Create the handler."""
        super().__init__()
        self._target = target

    def emit(self, record: logging.LogRecord) -> None:
        """Write a record."""
        self._target.write_line(self.format(record))
