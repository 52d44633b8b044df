# SPDX-License-Identifier: Apache-2.0
"""Services of a controller manager as functions, and programs that spawn controllers."""

from controller_manager.controller_manager_services import (
    bcolors,
    configure_controller,
    get_parameter_from_param_files,
    get_params_files_with_controller_parameters,
    list_controller_types,
    list_controllers,
    list_hardware_components,
    list_hardware_interfaces,
    load_controller,
    reload_controller_libraries,
    set_controller_parameters,
    set_controller_parameters_from_param_files,
    set_hardware_component_state,
    switch_controllers,
    unload_controller,
)

__all__ = [
    'bcolors',
    'configure_controller',
    'get_parameter_from_param_files',
    'get_params_files_with_controller_parameters',
    'list_controller_types',
    'list_controllers',
    'list_hardware_components',
    'list_hardware_interfaces',
    'load_controller',
    'reload_controller_libraries',
    'set_controller_parameters',
    'set_controller_parameters_from_param_files',
    'set_hardware_component_state',
    'switch_controllers',
    'unload_controller',
]
