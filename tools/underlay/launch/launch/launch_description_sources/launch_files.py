# SPDX-License-Identifier: Apache-2.0
"""How a launch file is loaded: one in Python, and one in any format."""

from __future__ import annotations

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_file_location
import os
from types import FunctionType, ModuleType

from launch.failures import CallSite, note_line
from launch.invalid_launch_file_error import InvalidFrontendLaunchFileError, InvalidLaunchFileError
from launch.launch_description import LaunchDescription
from launch.launch_description_source import LaunchDescriptionSource
from launch.substitution import SomeSubstitutionsType

_PYTHON = '.py'
_FUNCTION = 'generate_launch_description'
_MODULE_NAME = 'python_launch_file'
_OTHER_FORMATS = {
    '.xml': 'XMLLaunchDescriptionSource',
    '.yaml': 'YAMLLaunchDescriptionSource',
    '.yml': 'YAMLLaunchDescriptionSource',
}
_ADVICE = 'The file is not in Python: load it with {}, or with AnyLaunchDescriptionSource.'


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """
    Source that loads a launch file in Python.

    Parameters
    ----------
    launch_file_path
        The path of the file, as a string or substitutions.

    """

    _loads_file = True

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, 'interpreted python launch file')

    def _get_launch_description(self, location: str) -> LaunchDescription:
        try:
            return get_launch_description_from_python_launch_file(location)
        except SyntaxError as error:
            other = _OTHER_FORMATS.get(os.path.splitext(location)[1])
            if other is None:
                raise
            raise SyntaxError(f'{error}\n{_ADVICE.format(other)}') from error


class InvalidPythonLaunchFileError(InvalidLaunchFileError):
    """A Python file is not a launch file."""

    def __init__(self, text: str) -> None:
        """Create the error."""
        super().__init__('.py')
        self.args = (text,)


def load_python_launch_file_as_module(
    python_launch_file_path: str | os.PathLike[str],
) -> ModuleType:
    """
    Execute a launch file in Python as a module, which is not registered in `sys.modules`.

    Parameters
    ----------
    python_launch_file_path
        The path of the file; cached bytecode is not used.

    Raises
    ------
    InvalidPythonLaunchFileError
        No module can be created from the file.

    """
    path = os.fspath(python_launch_file_path)
    loader = SourceFileLoader(_MODULE_NAME, path)
    spec = spec_from_file_location(_MODULE_NAME, path, loader=loader)
    if spec is None:
        raise InvalidPythonLaunchFileError(f"launch file at '{path}' cannot be loaded")
    module = module_from_spec(spec)
    code = compile(loader.get_data(path), path, 'exec', dont_inherit=True)
    exec(code, module.__dict__)  # noqa: S102
    return module


def get_launch_description_from_python_launch_file(
    python_launch_file_path: str | os.PathLike[str],
) -> LaunchDescription:
    """
    Load the launch description that `generate_launch_description` of a file returns.

    Parameters
    ----------
    python_launch_file_path
        The path of the file.

    Raises
    ------
    FileNotFoundError
        The file does not exist.
    InvalidPythonLaunchFileError
        The file has no such function.
    AttributeError
        The function does not return a launch description.

    """
    path = os.fspath(python_launch_file_path)
    if not os.path.isfile(path):
        from ros_environment.missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('launch file', path))
    try:
        return _generate(path)
    except Exception as error:
        _point_at_line(path, error)
        raise


def _generate(path: str) -> LaunchDescription:
    module = load_python_launch_file_as_module(path)
    generate = getattr(module, _FUNCTION, None)
    if generate is None:
        raise InvalidPythonLaunchFileError(_without_function(path, module))
    description = generate()
    if not hasattr(description, 'visit'):
        raise AttributeError(
            f"'{type(description).__name__}' object has no attribute 'visit': the function "
            f"generate_launch_description() of '{path}' must return a LaunchDescription"
        )
    result: LaunchDescription = description
    return result


def _without_function(path: str, module: ModuleType) -> str:
    """Format the error about a launch file without its function, with a suggestion."""
    from ros_environment.suggestions import did_you_mean

    functions = [name for name, value in vars(module).items() if isinstance(value, FunctionType)]
    text = f"launch file at '{path}' does not contain the required function '{_FUNCTION}()'"
    close = did_you_mean(_FUNCTION, functions)
    return f'{text}\n{close} The function must be called {_FUNCTION}.' if close else text


def _point_at_line(path: str, error: Exception) -> None:
    """Record on an exception the last line of the launch file that led to it."""
    if isinstance(error, SyntaxError) and error.filename == path:
        note_line(error, CallSite(path, error.lineno or 0))
        return
    from traceback import walk_tb

    lines = [
        line for frame, line in walk_tb(error.__traceback__) if frame.f_code.co_filename == path
    ]
    note_line(error, CallSite(path, lines[-1] if lines else 0))


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """
    Source that loads a launch file in any format.

    Parameters
    ----------
    launch_file_path
        The path of the file, as a string or substitutions.

    """

    _loads_file = True

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, 'any launch file')

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_any_launch_file(location)


def get_launch_description_from_any_launch_file(
    launch_file_path: str | os.PathLike[str],
) -> LaunchDescription:
    """
    Load the launch description of a file, whatever its format.

    Parameters
    ----------
    launch_file_path
        The path of the file, whose extension determines the format that is tried first.

    Raises
    ------
    FileNotFoundError
        The file does not exist.
    InvalidLaunchFileError
        It could not be loaded in any format; the message states why.

    """
    path = os.fspath(launch_file_path)
    if not os.path.isfile(path):
        from ros_environment.missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('launch file', path))
    extension = os.path.splitext(path)[1]
    try:
        return _load_first(path, extension)
    except Exception as error:
        first = error
    try:
        return _load_second(path, extension)
    except Exception as error:
        raise _both(extension, first, error) from first


def _load_first(path: str, extension: str) -> LaunchDescription:
    """Load a file in the format of its extension."""
    if extension == _PYTHON:
        return get_launch_description_from_python_launch_file(path)
    return _load_other_format(path)


def _load_second(path: str, extension: str) -> LaunchDescription:
    """Load a file in the other format; files with the extension `.py` must be Python."""
    if extension == _PYTHON:
        raise InvalidFrontendLaunchFileError()
    return get_launch_description_from_python_launch_file(path)


def _load_other_format(path: str) -> LaunchDescription:
    from launch.frontend.parser import Parser

    root, parser = Parser.load(path)
    return parser.parse_description(root)


def _both(extension: str, first: Exception, second: Exception) -> InvalidLaunchFileError:
    """Create the error for a file that could not be loaded in either format."""
    unknown = isinstance(first, InvalidFrontendLaunchFileError) and not first.is_about_content
    if unknown and isinstance(second, SyntaxError):
        return InvalidFrontendLaunchFileError()
    return InvalidLaunchFileError(extension, likely_errors=[first, second])
