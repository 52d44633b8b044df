# SPDX-License-Identifier: Apache-2.0
"""The value of a Python expression."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import Any, TYPE_CHECKING

from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PythonExpression(Substitution):
    """
    Substitution of the value of a Python expression, as a text.

    Parameters
    ----------
    expression
        The expression, which can use the modules named, and no others.
    python_modules
        The names of these modules; the names in `math` can be used directly.

    """

    frontend_required = ('expression',)
    frontend_optional = ('python_modules',)

    def __init__(
        self,
        expression: SomeSubstitutionsType,
        python_modules: SomeSubstitutionsType = ('math',),
    ) -> None:
        self.__expression = normalize_to_list_of_substitutions(expression)
        self.__python_modules = normalize_to_list_of_substitutions(python_modules)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[Any, dict[str, Any]]:
        """
        Read the arguments of `eval`; the modules are separated by commas.

        Parameters
        ----------
        data
            The expression and the modules, each as a list of substitutions.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        _, kwargs = super().parse(data)
        if 'python_modules' in kwargs:
            from launch.launch_context import LaunchContext

            names = perform_substitutions(LaunchContext(), kwargs['python_modules'])
            kwargs['python_modules'] = [name.strip() for name in names.split(',')]
        return cls, kwargs

    @property
    def expression(self) -> list[Substitution]:
        """Return the expression as a list of substitutions."""
        return self.__expression

    @property
    def python_modules(self) -> list[Substitution]:
        """Return the names of the modules."""
        return self.__python_modules

    def describe(self) -> str:
        """Return a short human-readable description."""
        expression = ' + '.join(sub.describe() for sub in self.__expression)
        modules = ', '.join(sub.describe() for sub in self.__python_modules)
        return f'PythonExpr({expression}, [{modules}])'

    def perform(self, context: LaunchContext) -> str:
        """
        Evaluate the expression, which comes from the launch file, and return it as a string.

        Parameters
        ----------
        context
            The launch context, in which the expression is performed.

        Raises
        ------
        NameError
            The expression uses an unknown name.
        SyntaxError
            The expression is not valid Python.

        """
        expression = perform_substitutions(context, self.__expression)
        names = [context.perform_substitution(sub) for sub in self.__python_modules]
        try:
            return str(eval(expression, {}, _namespace(names)))  # noqa: S307
        except NameError as error:
            raise NameError(_with_advice(error, expression)) from error
        except SyntaxError as error:
            raise SyntaxError(_with_advice(error, expression)) from error


def _with_advice(error: Exception, expression: str) -> str:
    """Add the expression, and advice on missing quotes, to an error."""
    return (
        f'{error}\nThe expression is: {expression}\nA string in it needs quotes of its own, also '
        "around a substitution: [\"'\", LaunchConfiguration('x'), \"' == 'y'\"]"
    )


def _namespace(module_names: list[str]) -> dict[str, Any]:
    """Return the namespace: the modules by name, and the names in `math`."""
    modules = {name: import_module(name) for name in module_names}
    return {**vars(modules['math']), **modules} if 'math' in modules else dict(modules)
