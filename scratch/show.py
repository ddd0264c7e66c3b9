import json,sys
r=json.load(open(sys.argv[1]))
print('FA',r['falseAlarms'])
for k,v in r['byEffect'].items():
    g=lambda n:"%d/%d"%(v[n].get('count',0),v[n]['of'])
    print("%16s det %s top %s set %s size %.1f named %s right %s cov %s other %s"%(k,g('detected'),g('topOneWhenDetected'),g('truthInSetWhenDetected'),v['meanSetSize'] or 0,g('namedWhenDetected'),g('namedRightly'),g('intervalCoversWhenDetected'),g('somethingElseWhenDetected')))
e=r['effects']; print({k:(round(e[k].get('share',0),3),e[k]['of']) for k in e if isinstance(e[k],dict)}, e['meanSetSize'])
for k,v in r['bySize'].items(): print(k,v['detected'].get('share'),v['namedWhenDetected'].get('share'),v['intervalCoversWhenDetected'].get('share'))
for k,v in r['outsideLibrary'].items(): print(k,'det',v['detected'].get('share'),'wrong',v['wrongNameWhenDetected'].get('share'),'other',v['somethingElseWhenDetected'].get('share'),'unknown',v['unknownWhenDetected'].get('share'))
