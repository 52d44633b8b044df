# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'demo_nodes_py'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed', 'parameters/params.yaml']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Small nodes that show topics, services, parameters, events and logging.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'talker = demo_nodes_py.topics.talker:main',
            'listener = demo_nodes_py.topics.listener:main',
            'talker_qos = demo_nodes_py.topics.talker_qos:main',
            'listener_qos = demo_nodes_py.topics.listener_qos:main',
            'listener_serialized = demo_nodes_py.topics.listener_serialized:main',
            'add_two_ints_server = demo_nodes_py.services.add_two_ints_server:main',
            'add_two_ints_client = demo_nodes_py.services.add_two_ints_client:main',
            'add_two_ints_client_async = demo_nodes_py.services.add_two_ints_client_async:main',
            'introspection = demo_nodes_py.services.introspection:main',
            'async_param_client = demo_nodes_py.parameters.async_param_client:main',
            'set_parameters_callback = demo_nodes_py.parameters.set_parameters_callback:main',
            'matched_event_detect = demo_nodes_py.events.matched_event_detect:main',
            'use_logger_service = demo_nodes_py.logging.use_logger_service:main',
        ],
    },
)
