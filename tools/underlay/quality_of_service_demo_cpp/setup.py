# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import setup

package_name = 'quality_of_service_demo_cpp'
DEMOS = (
    'deadline',
    'incompatible_qos',
    'lifespan',
    'liveliness',
    'message_lost_listener',
    'message_lost_talker',
)

setup(
    name=package_name,
    version='0.1.0',
    packages=[],
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Executables of quality_of_service_demo_cpp, over quality_of_service_demo_py.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [f'{demo} = quality_of_service_demo_py.{demo}:main' for demo in DEMOS],
    },
)
