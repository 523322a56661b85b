"""What a page links to, and what can be linked to in it."""

from html.parser import HTMLParser


class Links(HTMLParser):
    def __init__(self):
        super().__init__()
        self.sources, self.ids, self.texts = [], [], []

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("src", "href", "xlink:href", "srcset", "data"):
                self.sources.append(value)
            if key == "id":
                self.ids.append(value)


def parsed(html):
    links = Links()
    links.feed(html)
    return links
