"""One HTML page that holds its pictures."""
import base64
import html
import io
import os

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

STYLE = """
body { font-family: sans-serif; max-width: 1240px; margin: 0 auto; padding: 0 12px 40px; line-height: 1.45; color: #111 }
h1 { font-size: 1.5em } h2 { font-size: 1.2em; margin-top: 2em; border-bottom: 1px solid #bbb }
figure { margin: 1em 0 } figcaption { color: #333; margin-top: 4px }
.wide { overflow-x: auto }
.wide img { display: block; max-width: 100%; height: auto }
@media (max-width: 900px) { .wide img { max-width: none } }
table { border-collapse: collapse; font-size: 90% } td, th { border: 1px solid #bbb; padding: 3px 8px; text-align: left }
td.number { text-align: right; font-variant-numeric: tabular-nums }
"""
# Dots per inch: figures of 11 inches fill the page. On narrower ones they shrink with it as long as their words can be read;
# then they scroll, as tables do.
DPI = 110


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return text == '-'


class Page:
    """Headings, texts, tables and figures in their order; each figure is a PNG file as well."""

    def __init__(self, folder):
        self.folder = folder
        self.parts = []
        os.makedirs(folder, exist_ok=True)

    def heading(self, words):
        self.parts.append(f'<h2>{html.escape(words)}</h2>')

    def text(self, words):
        self.parts.append(f'<p>{html.escape(words)}</p>')

    def figure(self, name, figure, caption):
        memory = io.BytesIO()
        figure.savefig(memory, dpi=DPI, bbox_inches='tight', format='png')
        plt.close(figure)
        with open(os.path.join(self.folder, name + '.png'), 'wb') as file:
            file.write(memory.getvalue())
        data = base64.b64encode(memory.getvalue()).decode('ascii')
        words = html.escape(caption)
        self.parts.append(f'<figure><div class="wide"><img alt="{words}" src="data:image/png;base64,{data}"></div>'
                          f'<figcaption>{words}</figcaption></figure>')

    def table(self, head, rows):
        def cell(text):
            text = str(text)
            kind = ' class="number"' if is_number(text) else ''
            return f'<td{kind}>{html.escape(text)}</td>'
        top = ''.join(f'<th>{html.escape(words)}</th>' for words in head)
        body = ''.join('<tr>' + ''.join(cell(text) for text in row) + '</tr>' for row in rows)
        self.parts.append(f'<div class="wide"><table><tr>{top}</tr>{body}</table></div>')

    def write(self, title):
        """@return the path of the page"""
        path = os.path.join(self.folder, 'index.html')
        with open(path, 'w', encoding='utf-8') as file:
            file.write('<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><link rel="icon" href="data:,">'
                       '<meta name="viewport" content="width=device-width, initial-scale=1">'
                       f'<title>{html.escape(title)}</title><style>{STYLE}</style></head><body>'
                       f'<h1>{html.escape(title)}</h1>' + '\n'.join(self.parts) + '</body></html>')
        return path
