# Sphinx: the reference of the Python package, from its docstrings. scripts/api_reference.sh builds it.
import corank

project = "corank"
author = "The corank developers"
copyright = author
version = release = corank.__version__
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.doctest"]
html_theme = "alabaster"
html_show_copyright = False
autodoc_member_order = "bysource"
autodoc_typehints = "description"
napoleon_google_docstring = True
