#!/usr/bin/env python3
"""Finds names of the standard library whose header a file does not include itself.

usage: check_includes.py

GCC 13 and 14 include fewer headers inside their own, so a file that relied on another header's includes stops building
there. A file may leave out what this package's own headers that it includes bring along. std::size_t comes with every
header of the library. Prints one line for each finding; exits 1 if there is one.
"""
import pathlib
import re
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
NAMES = {
    'cstdint': r'std::u?int(?:8|16|32|64)_t|std::uintptr_t',
    'cstring': r'std::(?:memcpy|memset|memcmp|memmove|strlen|strcmp)\b',
    'cmath': r'std::(?:sqrt|floor|ceil|isfinite|isnan|isinf|lround|lrint|pow|exp|log|hypot|nan|nanf)\(',
    'algorithm': r'std::(?:min|max|clamp|sort|fill|copy|transform|any_of|all_of|none_of|find_if|count_if|nth_element|'
                 r'min_element|max_element|minmax_element|reverse|unique|lower_bound|upper_bound|replace)\(',
    'numeric': r'std::(?:accumulate|iota|inner_product|partial_sum)\(',
    'iterator': r'std::(?:back_inserter|istreambuf_iterator|ostreambuf_iterator|make_move_iterator|next|prev|distance)\b',
    'limits': r'std::numeric_limits',
    'functional': r'std::function<|std::(?:multiplies|plus|minus|greater|less)<|std::ref\(',
    'memory': r'std::(?:unique_ptr|shared_ptr|make_unique|make_shared|weak_ptr)\b',
    'mutex': r'std::(?:mutex|lock_guard|unique_lock|scoped_lock|once_flag|call_once)\b',
    'condition_variable': r'std::condition_variable',
    'thread': r'std::(?:thread|this_thread)\b',
    'atomic': r'std::atomic',
    'chrono': r'std::chrono',
    'optional': r'std::(?:optional|nullopt|make_optional)\b',
    'variant': r'std::(?:variant|visit|get_if|holds_alternative)\b',
    'array': r'std::array\b',
    'vector': r'std::vector\b',
    'string': r'std::(?:string\b|to_string|stoi|stod|stof)',
    'map': r'std::map\b',
    'set': r'std::set\b',
    'deque': r'std::deque\b',
    'utility': r'std::(?:move|pair|exchange|swap|forward|make_pair)\b',
    'tuple': r'std::(?:tuple|tie|make_tuple)\b',
    'sstream': r'std::[io]?stringstream',
    'fstream': r'std::[io]?fstream',
    'iostream': r'std::(?:cout|cerr)\b',
    'iomanip': r'std::(?:setprecision|setw|setfill)\b',
    'filesystem': r'std::filesystem',
    'stdexcept': r'std::(?:runtime_error|invalid_argument|logic_error|out_of_range)\b',
    'exception': r'std::(?:exception\b|exception_ptr|current_exception|rethrow_exception|terminate)',
    'cstdlib': r'std::(?:getenv|system|abort|exit)\b',
    'cstdio': r'std::(?:printf|fprintf|snprintf|fopen|fclose|FILE)\b',
    'type_traits': r'std::(?:is_same_v|enable_if|conditional_t|decay_t|is_integral_v|is_floating_point_v|make_unsigned_t)\b',
    'new': r'std::bad_alloc|std::align_val_t',
}
PATTERNS = {header: re.compile(pattern) for header, pattern in NAMES.items()}
INCLUDE = re.compile(r'^#include [<"]([^>"]+)[>"]', re.M)


def resolve(name, path):
    """@return the file of this package that an include means, or None"""
    for folder in (path.parent, TOP / 'include', TOP / 'src', TOP / 'test', TOP / 'benchmark'):
        if (folder / name).is_file():
            return (folder / name).resolve()
    return None


def reachable(path, seen=None):
    """@return all headers that a file includes, itself or by way of this package's own headers"""
    seen = set() if seen is None else seen
    headers = set()
    for name in INCLUDE.findall(path.read_text(encoding='utf-8')):
        own = resolve(name, path)
        if own is None:
            headers.add(name)
        elif own not in seen:
            seen.add(own)
            headers |= reachable(own, seen)
    return headers


def main():
    files = subprocess.check_output(['git', '-C', str(TOP), 'ls-files', '*.cpp', '*.h'], text=True).split()
    findings = []
    for name in files:
        path = TOP / name
        text = re.sub(r'//.*', '', path.read_text(encoding='utf-8'))
        headers = reachable(path)
        findings += [f'{name}: uses {match.group(0)} without <{header}>' for header, pattern in PATTERNS.items()
                     if header not in headers and (match := pattern.search(text))]
    print('\n'.join(findings) if findings else f'includes: {len(files)} files')
    return 1 if findings else 0


if __name__ == '__main__':
    sys.exit(main())
