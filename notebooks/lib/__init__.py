"""What the pages need besides `neorl`: a folder per page with its toy systems and figures; `shared` serves several.

A page's folder may import all of `neorl` and the folders of chapters before it. `neorl` knows nothing of this one.
"""
