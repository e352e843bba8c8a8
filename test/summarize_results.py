#!/usr/bin/env python3
"""Counts the test cases in a folder of gtest and rostest result files.

usage: summarize_results.py FOLDER [TEST_PROGRAMS_THAT_FAILED]

Names each case that failed or was skipped and closes with 'N passed, N failed[, N skipped]'. A rostest writes one file
about its nodes and one for each node's own cases; the first kind counts only where it reports a failure. A test
program that failed without leaving a failed case (it died) counts as one failure.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def outcome(case):
    if case.find('failure') is not None or case.find('error') is not None:
        return 'failed'
    if case.find('skipped') is not None or case.get('status') == 'notrun' or case.get('result') == 'skipped':
        return 'skipped'
    return 'passed'


def main():
    folder = pathlib.Path(sys.argv[1])
    programs_failed = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    counts = {'passed': 0, 'failed': 0, 'skipped': 0}
    for path in sorted(folder.rglob('*.xml')):
        try:
            cases = list(ElementTree.parse(path).iter('testcase'))
        except ElementTree.ParseError:
            print(f'failed: {path.name} is not a readable result file')
            counts['failed'] += 1
            continue
        for case in cases:
            result = outcome(case)
            if path.name.startswith('rostest-') and result == 'passed':
                continue
            counts[result] += 1
            if result != 'passed':
                print(f"{result}: {case.get('classname')}.{case.get('name')}")
    if programs_failed and not counts['failed']:
        print(f'failed: {programs_failed} test program(s) that left no failed case; see the output above')
        counts['failed'] = programs_failed
    if not sum(counts.values()):
        sys.exit(f'No test left a result in {folder}.')
    skipped = f", {counts['skipped']} skipped" if counts['skipped'] else ''
    print(f"{counts['passed']} passed, {counts['failed']} failed{skipped}")
    sys.exit(1 if counts['failed'] else 0)


if __name__ == '__main__':
    main()
