# SPDX-License-Identifier: Apache-2.0
"""
The log of a launch: the screen, and files in a directory for each run.

These are its settings, and the loggers that use them.
"""

from __future__ import annotations

import logging
import os
import time
from typing import Optional, TYPE_CHECKING

from launch.logging._handlers import (
    log_formatter,
    LogFileHandler,
    LostFiles,
    screen_formatter,
    ScreenHandler,
)
from launch.logging._screen import screen
from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch.logging._output import get_output_loggers

__all__ = [
    'get_logger',
    'get_output_loggers',
    'launch_config',
    'log_launch_config',
    'reset',
]

_MAIN_LOG = 'launch.log'


class LaunchConfig:
    """Settings of the log: destinations, level and formats."""

    def __init__(self) -> None:
        """Create the default settings; nothing is written yet."""
        self.reset()

    def reset(self) -> None:
        """Reset to the default settings, with a new directory for the log files."""
        self._log_dir: Optional[str] = None
        self._keeps_files = True
        self._level = logging.INFO
        self._screen_formatter = screen_formatter(os.environ.get('OVERRIDE_LAUNCH_SCREEN_FORMAT'))
        self._log_formatter = log_formatter(os.environ.get('OVERRIDE_LAUNCH_LOG_FORMAT'))
        self._screen_handler: Optional[ScreenHandler] = None
        self._file_handlers: dict[str, LogFileHandler] = {}
        self.lost_files = LostFiles()

    @property
    def level(self) -> int:
        """Return the minimum level of logged messages."""
        return self._level

    @level.setter
    def level(self, value: int) -> None:
        """
        Set the minimum level of logged messages, also for existing loggers.

        Parameters
        ----------
        value
            A level of the module `logging`.

        """
        self._level = value
        for name in _known_loggers:
            logging.getLogger(name).setLevel(value)

    @property
    def log_dir(self) -> str:
        """Return the log directory of this run, which is created on demand."""
        if self._log_dir is None:
            self._log_dir = make_run_directory() if self._keeps_files else run_directory()
        return self._log_dir

    @log_dir.setter
    def log_dir(self, value: str) -> None:
        """
        Set the log directory of this run, and create it.

        Parameters
        ----------
        value
            The path of the directory.

        Raises
        ------
        RuntimeError
            Another directory is already in use.

        """
        if self._log_dir not in (None, value):
            raise RuntimeError(
                f"the folder of the log files is already '{self._log_dir}' and cannot become "
                f"'{value}'"
            )
        os.makedirs(value, exist_ok=True)
        self._log_dir = value

    def set_screen_format(self, screen_format: str) -> None:
        """
        Set the format of messages on the screen.

        Parameters
        ----------
        screen_format
            A brace-style format, `default` or `default_with_timestamp`.

        """
        self._screen_formatter = screen_formatter(screen_format)
        if self._screen_handler is not None:
            self._screen_handler.setFormatter(self._screen_formatter)

    def set_log_format(self, log_format: str) -> None:
        """
        Set the format of the main log file.

        Parameters
        ----------
        log_format
            A brace-style format, or `default`.

        """
        self._log_formatter = log_formatter(log_format)
        if _MAIN_LOG in self._file_handlers:
            self._file_handlers[_MAIN_LOG].setFormatter(self._log_formatter)

    def get_screen_handler(self) -> ScreenHandler:
        """Return the handler that writes to the screen."""
        if self._screen_handler is None:
            self._screen_handler = ScreenHandler()
            self._screen_handler.setFormatter(self._screen_formatter)
        return self._screen_handler

    def get_log_file_path(self, file_name: str = _MAIN_LOG) -> str:
        """
        Return the path of a log file of this run; its directory is created.

        Parameters
        ----------
        file_name
            The name of the file.

        """
        return os.path.join(self.log_dir, file_name)

    def get_log_file_handler(self, file_name: str = _MAIN_LOG) -> LogFileHandler:
        """
        Get the handler that writes to a log file, which is created on first use.

        Parameters
        ----------
        file_name
            The name of the file.

        """
        if file_name not in self._file_handlers:
            path = self.get_log_file_path if self._keeps_files else _nowhere
            handler = LogFileHandler(lambda: path(file_name), self.lost_files)
            handler.setFormatter(self._log_formatter)
            self._file_handlers[file_name] = handler
        return self._file_handlers[file_name]

    def keep_nothing(self) -> None:
        """Disable log files, and show only warnings and errors."""
        self._keeps_files = False
        self._file_handlers.clear()
        self.level = logging.WARNING

    def close(self) -> None:
        """Close the log files; they open again when something is written."""
        for handler in self._file_handlers.values():
            handler.close()


def _nowhere(file_name: str) -> str:
    return os.devnull


_known_loggers: list[Optional[str]] = []
launch_config = LaunchConfig()


def logger_at(name: Optional[str], level: int) -> logging.Logger:
    """
    Get a logger and set its level, without touching all other loggers for a new one.

    Parameters
    ----------
    name
        The name of the logger, None for the root.
    level
        The level.

    """
    is_new = name is not None and name not in logging.root.manager.loggerDict
    logger = logging.getLogger(name)
    if is_new:
        logger.level = level
    elif logger.level != level:
        logger.setLevel(level)
    return logger


def get_logger(name: Optional[str] = None) -> logging.Logger:
    """
    Get a logger that writes to the screen and to the main log file.

    Parameters
    ----------
    name
        The name of the logger, None for the root.

    """
    if name in _known_loggers:
        logger = logging.getLogger(name)
    else:
        _known_loggers.append(name)
        logger = logger_at(name, launch_config.level)
        logger.propagate = False
    handlers = [launch_config.get_screen_handler(), launch_config.get_log_file_handler()]
    if name is None:
        handlers = [each for each in handlers if each not in logger.handlers]
        for each in handlers:
            logger.addHandler(each)
    elif logger.handlers != handlers:
        logger.handlers = list(handlers)
    return logger


def log_launch_config(*, logger: Optional[logging.Logger] = None) -> None:
    """
    Log the log directory and the minimum level of logged messages.

    Parameters
    ----------
    logger
        The logger to use, by default `launch`.

    """
    target = get_logger('launch') if logger is None else logger
    target.info('All log files can be found below %s', launch_config.log_dir)
    level = logging.getLevelName(launch_config.level)
    target.info('Default logging verbosity is set to %s', level)


def reset() -> None:
    """Reset to the default settings, with a new directory for the log files."""
    launch_config.close()
    launch_config.reset()
    for name in _known_loggers:
        logger = logging.getLogger(name)
        logger.handlers = [
            each
            for each in logger.handlers
            if not isinstance(each, (ScreenHandler, LogFileHandler))
        ]
        logger.setLevel(launch_config.level)


def base_directory() -> str:
    """Return the base directory that contains the log directories of all runs."""
    explicit = os.environ.get('ROS_LOG_DIR')
    if explicit:
        return os.path.abspath(os.path.expanduser(explicit))
    home = os.environ.get('ROS_HOME') or os.path.join('~', '.ros')
    return os.path.abspath(os.path.join(os.path.expanduser(home), 'log'))


def run_directory() -> str:
    """Return the path of the log directory for a run that starts now."""
    now = _now_text(time.time())
    return os.path.join(base_directory(), f'{now}-{os.uname().nodename}-{os.getpid()}')


def make_run_directory() -> str:
    """Create the log directory of this run, and point the link `latest` to it."""
    path = run_directory()
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise RuntimeError(
            f"the folder '{path}' for the log files cannot be created: {error.strerror}; set "
            'ROS_LOG_DIR to a folder that you can write to'
        ) from error
    _point_latest_at(os.path.dirname(path), path)
    return path


def _now_text(now_s: float) -> str:
    """Format a local time with microseconds, such that the strings sort by time."""
    microseconds = int(now_s % 1 * 1e6)
    return f'{time.strftime("%Y-%m-%d-%H-%M-%S", time.localtime(now_s))}-{microseconds:06d}'


def _point_latest_at(base: str, path: str) -> None:
    """Replace the link `latest` atomically."""
    latest = os.path.join(base, 'latest')
    if os.path.exists(latest) and not os.path.islink(latest):
        screen.write_line(
            f"[WARNING] [launch]: '{latest}' is not a symbolic link and is left as it is, so it "
            'does not point to the log files of this run'
        )
        return
    temporary = f'{latest}.{os.getpid()}'
    try:
        os.symlink(path, temporary)
        os.replace(temporary, latest)
    except OSError:
        _remove_quietly(temporary)


def _remove_quietly(path: str) -> None:
    """Remove a file, and ignore errors."""
    try:
        os.unlink(path)
    except OSError:
        pass


__getattr__, __dir__ = lazy_exports(__name__, __all__, {'get_output_loggers': '_output'})
