# SPDX-License-Identifier: Apache-2.0
"""Launch actions for all nodes that follow: their parameters, remappings and namespace."""

from __future__ import annotations

import os
from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.node_names import (
    InvalidNameError,
    make_namespace_absolute,
    prefix_namespace,
    validate_namespace,
)
from launch_ros.utilities.parameters_and_remappings import (
    evaluate_parameter_dict,
    normalize_parameter_dict,
)

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetParameter(Action):
    """
    Sets a parameter of the nodes that follow, to the end of the group that it is in.

    Parameters
    ----------
    name
        The name of the parameter.
    value
        A scalar, a list, a ParameterValue, or substitutions, whose result is typed by YAML
        rules.
    **kwargs
        As for `Action`: `condition`.

    Raises
    ------
    TypeError
        The value is not a valid parameter value.

    """

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        key: Any = name if isinstance(name, (str, tuple, list)) else (name,)
        key = tuple(key) if isinstance(key, list) else key
        self.__parameter = normalize_parameter_dict({key: value})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_parameter` element, with the attributes `name` and `value`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        from launch_ros.utilities.parse_parameters import parse_value

        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.parse_substitution(entity.get_attr('name'))
        kwargs['value'] = parse_value(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """
        Set the parameter for the nodes that follow in this scope.

        The list of parameters is replaced, not modified in place, so that the end of the scope
        restores it.

        Parameters
        ----------
        context
            The launch context; its configuration `global_params` holds the global parameters.

        Raises
        ------
        TypeError
            The substituted value is not a valid parameter value.

        """
        known = context.launch_configurations.get('global_params', [])
        added = evaluate_parameter_dict(context, self.__parameter)
        context.launch_configurations['global_params'] = [*known, *added.items()]
        context.run.note(parameters=added)


class SetParametersFromFile(Action):
    """
    Gives a parameter file to the nodes that follow, to the end of the group that it is in.

    Parameters
    ----------
    filename
        The path; relative paths are resolved against the current directory.
    **kwargs
        As for `Action`: `condition`.

    """

    def __init__(self, filename: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__filename = normalize_to_list_of_substitutions(filename)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_parameters_from_file` element, with the attribute `filename`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['filename'] = parser.parse_substitution(entity.get_attr('filename'))
        return cls, kwargs

    def check_in_advance(self, context: LaunchContext) -> None:
        """
        Raise an error if the file is already known and does not exist.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        FileNotFoundError
            The file does not exist.

        """
        from launch.preflight import constant_text

        path = constant_text(self.__filename, context)
        if path is not None:
            _require(os.path.abspath(path))

    def execute(self, context: LaunchContext) -> None:
        """
        Add the file to the global parameters of the nodes that follow in this scope.

        Parameters
        ----------
        context
            The launch context; its configuration `global_params` holds files and parameters.

        Raises
        ------
        FileNotFoundError
            The file does not exist; the message suggests similar names.

        """
        path = os.path.abspath(perform_substitutions(context, self.__filename))
        _require(path)
        known = context.launch_configurations.get('global_params', [])
        context.launch_configurations['global_params'] = [*known, path]
        context.run.note(path=path)


def _require(path: str) -> None:
    """Raise an error if a parameter file does not exist."""
    if not os.path.isfile(path):
        from ros_environment.missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('parameter file', path))


class SetRemap(Action):
    """
    Remaps a name of the nodes that follow, to the end of the group that it is in.

    Parameters
    ----------
    src, dst
        The original and the new name.
    **kwargs
        As for `Action`: `condition`.

    """

    def __init__(
        self,
        src: SomeSubstitutionsType,
        dst: SomeSubstitutionsType,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__src = normalize_to_list_of_substitutions(src)
        self.__dst = normalize_to_list_of_substitutions(dst)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_remap` element, with the attributes `from` and `to`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['src'] = parser.parse_substitution(entity.get_attr('from'))
        kwargs['dst'] = parser.parse_substitution(entity.get_attr('to'))
        return cls, kwargs

    @property
    def src(self) -> list[Substitution]:
        """Return the original name, as substitutions."""
        return self.__src

    @property
    def dst(self) -> list[Substitution]:
        """Return the new name, as substitutions."""
        return self.__dst

    def execute(self, context: LaunchContext) -> None:
        """
        Add the remapping; it precedes those of the nodes themselves.

        Parameters
        ----------
        context
            The launch context; its configuration `ros_remaps` holds the global remappings.

        """
        rule = (
            perform_substitutions(context, self.__src),
            perform_substitutions(context, self.__dst),
        )
        known = context.launch_configurations.get('ros_remaps', [])
        context.launch_configurations['ros_remaps'] = [*known, rule]
        context.run.note(source=rule[0], target=rule[1])


class PushROSNamespace(Action):
    """
    Puts the nodes that follow below a namespace, to the end of the group that it is in.

    Parameters
    ----------
    namespace
        A relative namespace is appended to the current one; an absolute one replaces it.
    **kwargs
        As for `Action`: `condition`.

    """

    def __init__(self, namespace: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalize_to_list_of_substitutions(namespace)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `push_ros_namespace` element, with the attribute `namespace`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['namespace'] = parser.parse_substitution(entity.get_attr('namespace'))
        return cls, kwargs

    @property
    def namespace(self) -> list[Substitution]:
        """Return the namespace, as substitutions."""
        return self.__namespace

    def execute(self, context: LaunchContext) -> None:
        """
        Combine the namespace with the current one.

        Parameters
        ----------
        context
            The launch context; its configuration `ros_namespace` holds the namespace.

        Raises
        ------
        RuntimeError
            The resulting namespace is not allowed in ROS.

        """
        pushed = perform_substitutions(context, self.__namespace)
        previous = context.launch_configurations.get('ros_namespace')
        namespace = make_namespace_absolute(prefix_namespace(previous, pushed)) or '/'
        try:
            validate_namespace(namespace)
        except InvalidNameError as error:
            raise RuntimeError(
                'The resulting namespace is invalid: '
                f"[previous_namespace='{previous}', pushed_namespace='{pushed}']. {error}",
            ) from error
        context.launch_configurations['ros_namespace'] = namespace
        context.run.note(namespace=namespace)


PushRosNamespace = PushROSNamespace
